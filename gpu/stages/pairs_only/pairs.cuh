// The broad phase alone, as the threads of its last launch run it; bulk_launch.cuh has the launch before it.
#pragma once

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/stages/broad/broad_stage.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_search.cuh"
#include "gpu/stages/pairs_only/bulk_sort.cuh"

namespace broadside::gpu {

// Called by one thread, before any thread counts.
__device__ inline void start_counts(const PairsView& view) {
  *view.counters = Counters{};
  if (view.broad.start == Start::kBulk) *view.bulk.turns = 0;
}

// What a warp has in shared memory.
template <bool kIsBulk>
struct PairsScratch {
  PairQueue queue;
};
template <>
struct PairsScratch<true> {
  BulkNotes notes;
};

// Boxes in, pairs out. kIsBulk: the search is that of Start::kBulk, with kLanes lanes for each box.
template <bool kIsBulk, std::uint32_t kLanes = 1>
__device__ void run_pairs(const PairsView& view, unsigned char* shared) {
  const GridTeam grid(view.barrier);
  auto& scratch = reinterpret_cast<PairsScratch<kIsBulk>*>(shared)[threadIdx.x / 32];
  const BulkView& bulk = view.bulk;
  const bool is_sorted = kIsBulk && bulk.bins.shape.bins != 0;
  if (!is_sorted) {
    mark_begin(grid, view.outcome);
    if (grid.rank() == 0) start_counts(view);
    if constexpr (kIsBulk)
      bulk_count(grid, bulk, view.boxes, view.box_count);
    else
      for (std::uint64_t i = grid.rank(); i < view.box_count; i += grid.size())
        count_box(view.broad, i, unpack(view.boxes[i]));
    grid.sync();
    mark_end(grid, view.outcome, FindStep::kCount);
  }
  bool has_room = true;
  if constexpr (kIsBulk) {
    if (!is_sorted) {
      place_buckets(grid, bulk.bucket_mask, bulk.count, bulk.begin, &view.counters->entry_cursor);
      grid.sync();
      mark_end(grid, view.outcome, FindStep::kPlace);
      bulk_scatter(grid, bulk, view.boxes, view.box_count);
      grid.sync();
    }
    mark_end(grid, view.outcome, FindStep::kScatter);
    bulk_find<kLanes>(grid, bulk, view.boxes, {0, view.box_count}, scratch.notes, view.pairs, &view.counters->pairs);
  } else {
    has_room = find_candidates(grid, view.broad, view.boxes, view.box_count, view.pairs, view.counters, scratch.queue,
                               view.outcome);
  }
  grid.sync();
  if (grid.rank() != 0) return;
  mark_end(grid, view.outcome, FindStep::kSearch);
  view.counters->is_aborted = !has_room || view.counters->pairs > view.pairs.capacity ? 1 : 0;
  view.outcome->counters = *view.counters;
}

}  // namespace broadside::gpu
