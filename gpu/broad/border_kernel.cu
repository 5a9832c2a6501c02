#include "gpu/runtime/plain_launch.cuh"
#include "gpu/stages/pairs_only/border.cuh"

namespace broadside::gpu {
namespace {

__global__ void __launch_bounds__(kPlainThreads) border_kernel(const __grid_constant__ BorderView view) {
  run_borders(view);
}
__global__ void __launch_bounds__(kPlainThreads) digest_kernel(const __grid_constant__ PairDigestView view) {
  run_pair_digest(view);
}

}  // namespace

core::Status launch_borders(const BorderView& view, StreamHandle stream) {
  return launch_over(view.count, border_kernel, view, stream);
}

core::Status launch_pair_digest(const PairDigestView& view, StreamHandle stream) {
  return launch_over(view.count, digest_kernel, view, stream);
}

}  // namespace broadside::gpu
