// The work of a frame, counted after it: its searches run again over what it left on the device.
#pragma once

#include "gpu/stages/broad_stage.cuh"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/tile_stage.cuh"
#include "gpu/stages/work_count.cuh"
#include "gpu/work_view.hpp"

namespace broadside::gpu {

__device__ inline void add_of_warp(unsigned long long* sum, unsigned long long own) {
  for (unsigned step = 16; step > 0; step /= 2) own += __shfl_xor_sync(kFullWarp, own, step);
  if (lane() == 0 && own != 0) atomicAdd(sum, own);
}

// Few bodies' pairs are all tested, as tiles do.
__device__ inline void count_broad_work(const BroadWorkView& view, PairQueue& room) {
  const GridTeam grid;
  const BroadView& b = view.broad;
  const AppendView<core::Pair> nowhere;
  Counted work;
  WarpQueue queue(room, nowhere, &view.work->pairs);
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
    default:
      break;
  }
  queue.flush();
  add_of_warp(&view.work->broad_tests, work.test_count);
  add_of_warp(&view.work->broad_nodes, work.node_count);
}

// Hits of a first level one at a time, however many the frame looked at together: how many that were depends on the
// GPU.
__device__ inline void count_level_work(const LevelWorkView& view) {
  const GridTeam grid;
  Counted work;
  if (view.frame.broad.start == Start::kNone)
    confirm_by_brute_force(grid, view.frame, work);
  else
    confirm_pairs(grid, view.frame, work);
  add_of_warp(&view.work->level_tests, work.test_count);
}

}  // namespace broadside::gpu
