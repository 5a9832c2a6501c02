#include <algorithm>

#include "gpu/runtime/plain_launch.cuh"
#include "gpu/stages/rigid/told_stage.cuh"

namespace broadside::gpu {
namespace {

__global__ void __launch_bounds__(kPlainThreads) told_kernel(const __grid_constant__ ToldView view) {
  run_told(view);
}

}  // namespace

core::Status launch_told(const ToldView& view, StreamHandle stream) {
  return launch_over(std::max<std::uint64_t>(view.body_count, view.patch_count), told_kernel, view, stream);
}

}  // namespace broadside::gpu
