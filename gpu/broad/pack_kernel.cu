#include "gpu/runtime/plain_launch.cuh"
#include "gpu/stages/pairs_only/pack.cuh"

namespace broadside::gpu {
namespace {

__global__ void __launch_bounds__(kPlainThreads) pack_kernel(const __grid_constant__ PackView view) {
  run_pack(view);
}

__global__ void __launch_bounds__(kPlainThreads) gather_kernel(const __grid_constant__ GatherView view) {
  run_gather(view);
}

}  // namespace

core::Status launch_gather(const GatherView& view, StreamHandle stream) {
  return launch_over(view.count, gather_kernel, view, stream);
}

core::Status launch_pack(const PackView& view, StreamHandle stream) {
  return launch_over(view.count, pack_kernel, view, stream);
}

}  // namespace broadside::gpu
