// Counts the work of a frame after it: its searches run again over what it left on the device.
#pragma once

#include "gpu/stages/broad/broad_stage.cuh"
#include "gpu/stages/broad/tile_stage.cuh"
#include "gpu/stages/levels/confirm_stage.cuh"
#include "gpu/stages/pairs_only/bulk_search.cuh"
#include "gpu/stages/work_count.cuh"
#include "gpu/work/work_view.hpp"

namespace broadside::gpu {

__device__ inline void add_of_warp(unsigned long long* sum, unsigned long long own) {
  for (unsigned step = 16; step > 0; step /= 2) own += __shfl_xor_sync(kFullWarp, own, step);
  if (lane() == 0 && own != 0) atomicAdd(sum, own);
}

// Takes boxes in the order of their entries, so that the counts do not depend on which warp takes which box. (In
// bulk_find warps take boxes as they become free.)
__device__ inline Counted count_bulk_work(const GridPlaces& grid, const BroadWorkView& view, BulkNotes& notes) {
  const volatile std::uint32_t* known = view.bulk.levels;
  const LevelMarks marks{known[0], known[1]};
  BulkSearch<Counted> search(view.bulk, view.boxes, notes, {}, &view.work->pairs);
  for (std::uint64_t first = warp_rank(grid) * 32; first < view.box_count; first += warp_count(grid) * 32) {
    const std::uint64_t place = first + lane();
    search.find_partners(static_cast<std::uint32_t>(place), place < view.box_count, marks);
  }
  search.flush();
  return search.work();
}

// A small frame tests all pairs, as tiles do.
__device__ inline void count_broad_work(const BroadWorkView& view, BulkNotes& room) {
  const GridPlaces grid;
  const BroadView& b = view.broad;
  const AppendView<core::Pair> nowhere;
  Counted work;
  WarpQueue queue(room.queue, nowhere, &view.work->pairs);
  switch (b.start) {
    case Start::kTiles:
      find_pairs_by_tiles(grid, view.boxes, view.box_count, nullptr, nowhere, &view.work->pairs, work);
      break;
    case Start::kGrid:
      grid_find(grid, b.grid, view.box_count, queue, work);
      break;
    case Start::kOctree:
      find_pairs_by_tiles(grid, b.octree.sorted, view.box_count, b.octree.range_end, nowhere, &view.work->pairs, work);
      break;
    case Start::kHash:
      hash_find(grid, b.hash, view.boxes, view.box_count, view.counters, queue, work);
      break;
    case Start::kBulk:
      work = count_bulk_work(grid, view, room);
      break;
    case Start::kNone:
      break;
  }
  queue.flush();
  add_of_warp(&view.work->broad_tests, work.test_count);
  add_of_warp(&view.work->broad_nodes, work.node_count);
}

// Descends hits of a first level one at a time. A frame may descend several at once, but how many depends on the GPU,
// and counts must not depend on it.
__device__ inline void count_level_work(const LevelWorkView& view) {
  const GridPlaces grid;
  Counted work;
  if (view.start == Start::kNone)
    confirm_by_brute_force(grid, view.frame, work);
  else
    confirm_pairs(grid, view.frame, work);
  add_of_warp(&view.work->level_tests, work.test_count);
}

}  // namespace broadside::gpu
