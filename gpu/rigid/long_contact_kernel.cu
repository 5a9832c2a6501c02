// The kernel that compiles the code of all shapes. It finds the contacts that near_contact_kernel.cu leaves, and it
// stops fast bodies short.
#include <algorithm>
#include <cstdint>

#include "gpu/rigid/contact_launch.hpp"
#include "gpu/rigid/swept_launch.hpp"
#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/contact_frame.cuh"
#include "gpu/stages/rigid/swept_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Two: 128 registers a thread.
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;

// What a launch does.
enum class LongTask : std::uint8_t { kContacts, kStopShort };

struct LongView {
  SweptView view;  // for kContacts only view.bodies is set
  LongTask task = LongTask::kContacts;
};

// One kernel for both tasks: the compiler makes the code of all shapes again in every kernel that calls it, a minute
// each.
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    long_contact_kernel(const __grid_constant__ LongView launched) {
  if (launched.task == LongTask::kStopShort)
    run_stop_short(launched.view);
  else
    run_long_contacts(launched.view.bodies);
}

__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    ways_kernel(const __grid_constant__ SweptView view) {
  run_ways(view);
}

}  // namespace

core::Result<LaunchShape> long_contact_launch_shape() {
  auto shape = contact_launch_shape();  // an error if this GPU cannot launch it
  if (!shape.ok()) return shape.error();
  LaunchShape own{kThreads, 0, 0, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(long_contact_kernel), own));
  return own;
}

core::Status launch_long_contacts(const ContactView& frame, const LaunchShape& shape, StreamHandle stream) {
  return launch(long_contact_kernel, LongView{{.bodies = frame}, LongTask::kContacts}, shape, stream);
}

core::Result<LaunchShape> swept_launch_shape() {
  return long_contact_launch_shape();
}

core::Status launch_ways(const SweptView& view, StreamHandle stream) {
  const std::uint32_t blocks = std::max((view.bodies.body_count + kThreads - 1) / kThreads, 1U);
  ways_kernel<<<blocks, kThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the ways of bodies");
}

core::Status launch_stop_short(const SweptView& view, const LaunchShape& shape, StreamHandle stream) {
  return launch(long_contact_kernel, LongView{view, LongTask::kStopShort}, shape, stream);
}

}  // namespace broadside::gpu
