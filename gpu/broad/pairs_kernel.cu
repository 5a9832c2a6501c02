#include <algorithm>

#include "gpu/broad/named_pairs_view.hpp"
#include "gpu/broad/shared_boxes.hpp"
#include "gpu/runtime/kernel_launch.cuh"
#include "gpu/stages/pairs_only/bulk_launch.cuh"
#include "gpu/stages/pairs_only/pairs.cuh"

namespace broadside::gpu {
namespace {

constexpr std::uint32_t kThreads = 512;
constexpr std::uint32_t kBlocksPerMultiprocessor = 2;
// Tiles and bins fill a multiprocessor's shared memory.
constexpr std::uint32_t kSortThreads = 1024;

template <bool kIsBulk, std::uint32_t kLanes>
__global__ void __launch_bounds__(kThreads, kBlocksPerMultiprocessor)
    pairs_kernel(const __grid_constant__ PairsView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_pairs<kIsBulk, kLanes>(view, shared);
}

__global__ void __launch_bounds__(kSortThreads, 1) sort_kernel(const __grid_constant__ PairsView view) {
  extern __shared__ __align__(16) unsigned char shared[];
  run_sort(view, shared);
}

using PairsKernel = void (*)(PairsView);

PairsKernel kernel_of(Start start, std::uint32_t lanes_per_box) {
  if (start != Start::kBulk) return pairs_kernel<false, 1>;
  return lanes_per_box == 1 ? pairs_kernel<true, 1> : pairs_kernel<true, kLanesOfCrowd>;
}

core::Result<LaunchShape> search_shape(Start start, std::uint32_t lanes_per_box) {
  const std::size_t scratch = start == Start::kBulk ? sizeof(PairsScratch<true>) : sizeof(PairsScratch<false>);
  LaunchShape shape{kThreads, 0, kThreads / 32 * static_cast<std::uint32_t>(scratch), 0};
  BROADSIDE_TRY(fit(reinterpret_cast<const void*>(kernel_of(start, lanes_per_box)), shape));
  return shape;
}

}  // namespace

core::Result<PairsShape> pairs_launch_shape(Start start, std::uint32_t boxes, std::uint32_t buckets,
                                            const BinLimits& limits) {
  if (start == Start::kBulk) return bulk_launch_shape(boxes, buckets, limits, 1);
  PairsShape shape;
  auto search = search_shape(start, 1);
  if (!search.ok()) return search.error();
  shape.search = search.value();
  return shape;
}

core::Result<PairsShape> bulk_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits,
                                           std::uint32_t lanes_per_box) {
  PairsShape shape;
  auto search = search_shape(Start::kBulk, lanes_per_box);
  if (!search.ok()) return search.error();
  shape.search = search.value();
  if (boxes < limits.least_boxes) return shape;
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
  if (view.broad.start == Start::kBulk) return launch_bulk(view, shape, 1, stream);
  return launch(kernel_of(view.broad.start, 1), view, shape.search, stream);
}

core::Status launch_bulk(const PairsView& view, const PairsShape& shape, std::uint32_t lanes_per_box,
                         StreamHandle stream) {
  if (shape.bins.bins != 0) BROADSIDE_TRY(launch_sort(view, shape, stream));
  return launch(kernel_of(Start::kBulk, lanes_per_box), view, shape.search, stream);
}

}  // namespace broadside::gpu
