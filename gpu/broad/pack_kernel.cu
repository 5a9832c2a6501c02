#include "gpu/runtime/plain_launch.cuh"
#include "gpu/stages/pairs_only/pack.cuh"

namespace broadside::gpu {
namespace {

__global__ void __launch_bounds__(kPlainThreads) pack_kernel(const __grid_constant__ PackView view) {
  run_pack(view);
}

}  // namespace

core::Status launch_pack(const PackView& view, StreamHandle stream) {
  return launch_over(view.count, pack_kernel, view, stream);
}

}  // namespace broadside::gpu
