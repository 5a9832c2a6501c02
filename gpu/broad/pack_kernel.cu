#include <algorithm>

#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/pack.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Enough to hide the latency of reading memory once.
constexpr std::uint32_t kBlocksPerMultiprocessor = 8;

__global__ void __launch_bounds__(kThreads) pack_kernel(const __grid_constant__ PackView view) {
  run_pack(view);
}

}  // namespace

core::Status launch_pack(const PackView& view, StreamHandle stream) {
  auto multiprocessors = attribute(cudaDevAttrMultiProcessorCount);
  if (!multiprocessors.ok()) return multiprocessors.error();
  const std::uint32_t blocks =
      std::clamp((view.count + kThreads - 1) / kThreads, 1U, kBlocksPerMultiprocessor * multiprocessors.value());
  pack_kernel<<<blocks, kThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching the packing of boxes");
}

}  // namespace broadside::gpu
