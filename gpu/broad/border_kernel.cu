#include <algorithm>

#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/border.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Enough to hide the latency of reading memory once.
constexpr std::uint64_t kBlocksPerMultiprocessor = 8;

__global__ void __launch_bounds__(kThreads) border_kernel(const __grid_constant__ BorderView view) {
  run_borders(view);
}
__global__ void __launch_bounds__(kThreads) digest_kernel(const __grid_constant__ PairDigestView view) {
  run_pair_digest(view);
}

template <typename View>
core::Status launch_over(void (*kernel)(View), const View& view, StreamHandle stream) {
  auto multiprocessors = attribute(cudaDevAttrMultiProcessorCount);
  if (!multiprocessors.ok()) return multiprocessors.error();
  const std::uint64_t blocks = std::clamp<std::uint64_t>((view.count + kThreads - 1) / kThreads, 1,
                                                         kBlocksPerMultiprocessor * multiprocessors.value());
  kernel<<<static_cast<std::uint32_t>(blocks), kThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching a kernel");
}

}  // namespace

core::Status launch_borders(const BorderView& view, StreamHandle stream) {
  return launch_over(border_kernel, view, stream);
}

core::Status launch_pair_digest(const PairDigestView& view, StreamHandle stream) {
  return launch_over(digest_kernel, view, stream);
}

}  // namespace broadside::gpu
