// Runs the launches of frames and of pairs on fibers of the host.
#include <algorithm>

#include "gpu/broad/named_pairs_view.hpp"
#include "gpu/broad/shared_boxes.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/on_host/small_grid.hpp"
#include "gpu/stages/digest.cuh"
#include "gpu/stages/grid_frame.cuh"
#include "gpu/stages/pairs_only/bulk_launch.cuh"
#include "gpu/stages/pairs_only/pairs.cuh"
#include "gpu/stages/small_frame.cuh"

namespace broadside::gpu {
namespace {

using on_host::kBlocks;
using on_host::kThreads;
constexpr std::uint32_t kSharedBytes = 1U << 17U;

on_host::Launch launch_of(const LaunchShape& shape) {
  return {{shape.blocks}, {shape.threads}, on_host::order_seed()};
}

}  // namespace

core::Result<LaunchShape> frame_launch_shape(std::uint32_t tree_levels) {
  const std::uint32_t bytes_per_warp = std::max(stack_entries_of(tree_levels) * kBytesPerStackEntry,
                                                static_cast<std::uint32_t>((sizeof(PairQueue) + 15) / 16 * 16));
  return LaunchShape{kThreads, kBlocks, kThreads / 32 * bytes_per_warp, kBlocks};
}

core::Status launch_frame(const SmallFrameView& frame, const LaunchShape& shape, StreamHandle /*stream*/) {
  std::vector<SmallScratch> scratch(shape.blocks);
  on_host::run(launch_of(shape), shape.shared_bytes + sizeof(BlockShapes),
               [&](unsigned char* shared) { run_small_frame(frame, scratch[blockIdx.x], shared); });
  return core::Done{};
}

core::Status launch_frame(const GridFrameView& frame, const LaunchShape& shape, StreamHandle /*stream*/) {
  std::vector<GridScratch> scratch(shape.blocks);
  const bool has_thread_per_body = frame.body_count <= shape.all_threads();
  on_host::run(launch_of(shape), shape.shared_bytes, [&](unsigned char* shared) {
    if (has_thread_per_body)
      run_grid_frame<true>(frame, scratch[blockIdx.x], shared);
    else
      run_grid_frame<false>(frame, scratch[blockIdx.x], shared);
  });
  return core::Done{};
}

core::Result<PairsShape> pairs_launch_shape(Start start, std::uint32_t boxes, std::uint32_t buckets,
                                            const BinLimits& limits) {
  const bool is_bulk = start == Start::kBulk;
  const std::size_t each = is_bulk ? sizeof(PairsScratch<true>) : sizeof(PairsScratch<false>);
  PairsShape shape;
  shape.search = {kThreads, kBlocks, kThreads / 32 * static_cast<std::uint32_t>(each), kBlocks};
  if (!is_bulk || boxes < limits.least_boxes) return shape;
  shape.bins = bins_shape(kThreads, boxes, buckets, kSharedBytes, limits.most_at_once);
  shape.sort = {kThreads, kBlocks, shape.bins.shared_bytes, kBlocks};
  return shape;
}

core::Status launch_sort(const PairsView& view, const PairsShape& shape, StreamHandle /*stream*/) {
  on_host::run(launch_of(shape.sort), shape.sort.shared_bytes, [&](unsigned char* shared) { run_sort(view, shared); });
  return core::Done{};
}

core::Status launch_pairs(const PairsView& view, const PairsShape& shape, StreamHandle stream) {
  if (view.broad.start == Start::kBulk) return launch_bulk(view, shape, 1, stream);
  on_host::run(launch_of(shape.search), shape.search.shared_bytes,
               [&](unsigned char* shared) { run_pairs<false>(view, shared); });
  return core::Done{};
}

core::Result<PairsShape> bulk_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits,
                                           std::uint32_t /*lanes_per_box*/) {
  return pairs_launch_shape(Start::kBulk, boxes, buckets, limits);
}

core::Status launch_bulk(const PairsView& view, const PairsShape& shape, std::uint32_t lanes_per_box,
                         StreamHandle stream) {
  if (shape.bins.bins != 0) BROADSIDE_TRY(launch_sort(view, shape, stream));
  on_host::run(launch_of(shape.search), shape.search.shared_bytes, [&](unsigned char* shared) {
    if (lanes_per_box == 1)
      run_pairs<true, 1>(view, shared);
    else
      run_pairs<true, kLanesOfCrowd>(view, shared);
  });
  return core::Done{};
}

core::Status launch_digest(const DigestView& view, std::uint32_t /*multiprocessors*/, StreamHandle /*stream*/) {
  std::vector<unsigned long long> sums(kBlocks);
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0,
               [&](unsigned char*) { run_digest(view, &sums[blockIdx.x]); });
  return core::Done{};
}

}  // namespace broadside::gpu
