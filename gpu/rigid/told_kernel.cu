#include <algorithm>

#include "gpu/runtime/cuda_check.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/rigid/told_stage.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 256;
// Enough to hide the latency of reading memory once.
constexpr std::uint64_t kBlocksPerMultiprocessor = 8;

__global__ void __launch_bounds__(kThreads) told_kernel(const __grid_constant__ ToldView view) {
  run_told(view);
}

}  // namespace

core::Status launch_told(const ToldView& view, StreamHandle stream) {
  auto multiprocessors = attribute(cudaDevAttrMultiProcessorCount);
  if (!multiprocessors.ok()) return multiprocessors.error();
  const std::uint64_t items = std::max<std::uint64_t>({view.body_count, view.patch_count, 1});
  const std::uint64_t most = kBlocksPerMultiprocessor * static_cast<std::uint64_t>(multiprocessors.value());
  told_kernel<<<static_cast<std::uint32_t>(std::min((items + kThreads - 1) / kThreads, most)), kThreads, 0, stream>>>(
      view);
  return cuda_status(cudaGetLastError(), "launching what a frame tells");
}

}  // namespace broadside::gpu
