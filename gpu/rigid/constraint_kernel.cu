// The kernel of a frame of turning bodies that colors its patches and makes their constraints.
#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/constraint_frame.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kConstraintThreads = 256;
constexpr std::uint32_t kConstraintBlocksPerMultiprocessor = 2;

__global__ void __launch_bounds__(kConstraintThreads, kConstraintBlocksPerMultiprocessor)
    constraint_kernel(const __grid_constant__ RigidFrameView frame) {
  run_constraints(frame);
}

}  // namespace

core::Result<LaunchShape> constraint_launch_shape() {
  LaunchShape shape{kConstraintThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(constraint_kernel), shape));
  return shape;
}

core::Status launch_constraints(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(constraint_kernel, frame, shape, stream);
}

}  // namespace broadside::gpu
