// The broad phase of a frame, of any kind: boxes in, candidate pairs out.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/broad/grid_stage.cuh"
#include "gpu/stages/broad/hash_stage.cuh"
#include "gpu/stages/broad/octree_stage.cuh"
#include "gpu/stages/broad/tile_stage.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Counts a box into its cells, which must be done for all boxes before any is placed: a barrier of the team must follow
// before find_candidates.
__device__ inline void count_box(const BroadView& b, std::uint64_t body, const core::Box& box) {
  if (b.start == Start::kGrid) grid_count(b.grid, body, box);
  if (b.start == Start::kOctree) octree_count(b.octree, body, box);
}

// Returns false if the spatial hash has no room for its entries; then the counters say how much it needs. Marks the
// ends of placing and scattering in `outcome`, unless that is null.
template <typename Team>
__device__ bool find_candidates(const Team& team, const BroadView& b, const PackedBox* boxes, std::uint32_t count,
                                AppendView<core::Pair> out, Counters* counters, PairQueue& room, Outcome* outcome) {
  // A step that a start does not have ends when the step before it does.
  const auto mark = [&](FindStep ended) {
    if (outcome != nullptr) mark_end(team, outcome, ended);
  };
  WarpQueue queue(room, out, &counters->pairs);
  Uncounted work;
  switch (b.start) {
    case Start::kTiles:
      mark(FindStep::kPlace), mark(FindStep::kScatter);
      find_pairs_by_tiles(team, boxes, count, nullptr, out, &counters->pairs, work);
      break;
    case Start::kGrid:
      place_buckets(team, b.grid.bucket_mask, b.grid.count, b.grid.begin, &counters->entry_cursor);
      team.sync();
      mark(FindStep::kPlace);
      grid_scatter(team, b.grid, boxes, count);
      team.sync();
      mark(FindStep::kScatter);
      grid_find(team, b.grid, count, queue, work);
      break;
    case Start::kOctree:
      octree_place_nodes(team, b.octree);
      team.sync();
      mark(FindStep::kPlace);
      octree_scatter(team, b.octree, boxes, count);
      team.sync();
      mark(FindStep::kScatter);
      find_pairs_by_tiles(team, b.octree.sorted, count, b.octree.range_end, out, &counters->pairs, work);
      break;
    case Start::kHash:
      hash_count(team, b.hash, boxes, count, counters);
      team.sync();
      if (counters->entries > b.hash.entries.capacity) {
        hash_clear(team, b.hash);
        return false;
      }
      place_buckets(team, b.hash.bucket_mask, b.hash.count, b.hash.begin, &counters->entry_cursor);
      team.sync();
      mark(FindStep::kPlace);
      hash_scatter(team, b.hash, boxes, count);
      team.sync();
      mark(FindStep::kScatter);
      hash_find(team, b.hash, boxes, count, counters, queue, work);
      hash_clear(team, b.hash);
      break;
    case Start::kNone:
    case Start::kBulk:  // in pairs.cuh
      break;
  }
  queue.flush();
  return true;
}

}  // namespace broadside::gpu
