#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/continuous/impact_stage.cuh"

namespace broadside::gpu {
namespace {

using continuous::FeatureKind;

constexpr std::uint32_t kImpactThreads = 128;
constexpr std::uint32_t kResidentBlocks = 4;  // of a multiprocessor, so that a thread has 128 registers
// No block waits for another, so there may be more than are resident: then multiprocessors end at about the same time.
constexpr std::uint32_t kImpactBlocksPerMultiprocessor = 16;

template <FeatureKind kKind>
__global__ void __launch_bounds__(kImpactThreads, kResidentBlocks)
    look_kernel(const __grid_constant__ ImpactView view) {
  look_at_queries<kKind>(view);
}

template <FeatureKind kKind>
__global__ void __launch_bounds__(kImpactThreads) search_kernel(const __grid_constant__ ImpactView view) {
  search_left<kKind>(view);
}

template <FeatureKind kKind>
core::Status launch_kind(const ImpactView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  BROADSIDE_CUDA_TRY(cudaMemsetAsync(&view.counts->left, 0, sizeof view.counts->left, stream));
  const std::uint32_t blocks = kImpactBlocksPerMultiprocessor * multiprocessors;
  look_kernel<kKind><<<blocks, kImpactThreads, 0, stream>>>(view);
  search_kernel<kKind><<<blocks, kImpactThreads, 0, stream>>>(view);
  return cuda_status(cudaGetLastError(), "launching continuous collision");
}

}  // namespace

core::Status launch_impacts(const ImpactView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  return view.kind == FeatureKind::kVertexFace ? launch_kind<FeatureKind::kVertexFace>(view, multiprocessors, stream)
                                               : launch_kind<FeatureKind::kEdgeEdge>(view, multiprocessors, stream);
}

core::Result<std::uint32_t> multiprocessor_count() {
  return attribute(cudaDevAttrMultiProcessorCount);
}

}  // namespace broadside::gpu
