// The kernels of a frame of turning bodies that wake sleeping bodies and put bodies to sleep.
#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/sleep_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kSleepThreads = 256;

__global__ void __launch_bounds__(kSleepThreads) wake_kernel(const __grid_constant__ RigidFrameView frame) {
  run_wake(frame);
}

__global__ void __launch_bounds__(kSleepThreads) fall_asleep_kernel(const __grid_constant__ RigidFrameView frame) {
  run_fall_asleep(frame);
}

}  // namespace

core::Result<LaunchShape> sleep_launch_shape() {
  LaunchShape wake{kSleepThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(wake_kernel), wake));
  LaunchShape shape{kSleepThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(fall_asleep_kernel), shape));
  shape.blocks = wake.blocks < shape.blocks ? wake.blocks : shape.blocks;
  return shape;
}

core::Status launch_wake(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(wake_kernel, frame, shape, stream);
}

core::Status launch_fall_asleep(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(fall_asleep_kernel, frame, shape, stream);
}

}  // namespace broadside::gpu
