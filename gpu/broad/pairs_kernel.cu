#include <algorithm>

#include "gpu/broad/named_pairs_view.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/bulk_launch.cuh"
#include "gpu/stages/pairs_only/pairs.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 512;
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;
// Tiles and bins fill a multiprocessor's shared memory.
constexpr std::uint32_t kSortThreads = 1024;

template <bool kIsBulk>
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    pairs_kernel(const __grid_constant__ PairsView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_pairs<kIsBulk>(view, shared);
}

__global__ void __launch_bounds__(kSortThreads, 1) sort_kernel(const __grid_constant__ PairsView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_sort(view, shared);
}

template <bool kIsBulk>
core::Result<LaunchShape> search_shape() {
  LaunchShape shape{kThreads, 0, kThreads / 32 * static_cast<std::uint32_t>(sizeof(PairsScratch<kIsBulk>)), 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(pairs_kernel<kIsBulk>), shape));
  return shape;
}

}  // namespace

core::Result<PairsShape> pairs_launch_shape(Start start, std::uint32_t boxes, std::uint32_t buckets,
                                            const BinLimits& limits) {
  PairsShape shape;
  auto search = start == Start::kBulk ? search_shape<true>() : search_shape<false>();
  if (!search.ok()) return search.error();
  shape.search = search.value();
  if (start != Start::kBulk || boxes < limits.least_boxes) return shape;
  auto block_limit = attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin);
  if (!block_limit.ok()) return block_limit.error();
  const BinsShape bins = bins_shape(kSortThreads, boxes, buckets, block_limit.value(), limits.most_at_once);
  if (bins.bins == 0) return shape;
  shape.sort = {kSortThreads, 0, bins.shared_bytes, 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(sort_kernel), shape.sort));
  if (shape.sort.blocks != 0) shape.bins = bins;
  return shape;
}

core::Status launch_sort(const PairsView& view, const PairsShape& shape, StreamHandle stream) {
  return launch(sort_kernel, view, shape.sort, stream);
}

core::Status launch_pairs(const PairsView& view, const PairsShape& shape, StreamHandle stream) {
  if (view.broad.start != Start::kBulk) return launch(pairs_kernel<false>, view, shape.search, stream);
  if (shape.bins.bins != 0) BROADSIDE_TRY(launch_sort(view, shape, stream));
  return launch(pairs_kernel<true>, view, shape.search, stream);
}

}  // namespace broadside::gpu
