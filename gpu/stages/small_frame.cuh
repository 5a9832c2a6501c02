// A small frame from top to bottom, as the threads of one launch run it: METHOD sections 1 to 6. The grid waits for all
// its blocks once after pairs are found, once after vertices, and once more for each time that leftover work is shared.
#pragma once

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/stages/broad/small_stage.cuh"
#include "gpu/stages/frame_report.cuh"
#include "gpu/stages/grid/dependent_launch.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/frame_response.cuh"
#include "gpu/stages/vertices/proximity_stage.cuh"

namespace broadside::gpu {

// What a block has in shared memory in addition to `shared`.
struct SmallScratch {
  ProximityScratch proximity;
  BlockCopy octree_copy;
  BlockCopy upper_copy;
  unsigned long long tally;
  Counters counters;
  std::uint32_t listed;
};

// Called by one thread once no other thread adds to the tally. Clears the tally for the next frame.
__device__ inline void report_small(const SmallFrameView& f, const Counters& counters, const SmallCounts& counts,
                                    bool is_aborted) {
  *f.given_out = 0;
  tell_host(f, counters, is_aborted);
  if (const unsigned long long tally = counts.packed(); tally != 0) atomicAdd(f.barrier, 0ULL - tally);
}

// Counters with the pairs that were counted in the tally. The counters in memory stay zero until the frame is reported.
__device__ inline Counters counters_of(const SmallFrameView& f, const SmallCounts& counts) {
  Counters counters;
  counters.pairs = counts.pairs;
  counters.confirmed = counts.confirmed(f);
  return counters;
}

// Called by all threads if there is not enough room for the pairs or the confirmed pairs. The grid synchronizes first:
// a block that read the tally after it was cleared would not abort, and would wait for the others forever.
__device__ inline void abort_small(const GridTeam& grid, const SmallFrameView& f, const SmallCounts& counts,
                                   std::uint64_t confirmed) {
  grid.sync();
  if (blockIdx.x != 0 || threadIdx.x != 0) return;
  Counters counters = counters_of(f, counts);
  counters.confirmed = max(std::uint64_t{counters.confirmed}, confirmed);
  report_small(f, counters, counts, true);
}

// Resolves contacts and faces, by all threads of one block.
__device__ inline void resolve_small(const SmallFrameView& f, const NarrowPairs& pairs, const SmallCounts& counts,
                                     SmallScratch& scratch, unsigned char* shared) {
  if (BlockRoom::fits(f, pairs.count)) {
    if (threadIdx.x == 0) scratch.counters = counters_of(f, counts);
    const BlockRoom room(shared, f.body_count, static_cast<std::uint32_t>(pairs.count));
    resolve_alone(f, pairs, room, scratch.counters);
    if (threadIdx.x == 0) report_small(f, scratch.counters, counts, !has_room_for_faces(f, scratch.counters));
    return;
  }
  const BlockTeam team;
  resolve_by_team(team, f, pairs, [&](std::uint64_t count) {
    resolve_body_by_body(team, f, count, BlockLive{reinterpret_cast<LiveBody*>(shared)});
  });
  if (team.rank() != 0) return;
  Counters counters = *f.counters;
  counters.pairs = counts.pairs;
  counters.confirmed = counts.confirmed(f);
  report_small(f, counters, counts, !has_room_for_faces(f, counters));
}

// `shared`: the block's shared memory, as large as LaunchShape says, with BlockShapes at its end. Always inlined,
// because a call would pass the view through memory.
__device__ __forceinline__ void run_small_frame(const SmallFrameView& f, SmallScratch& scratch, unsigned char* shared) {
  const ShapesInBlock shapes(f, shared, scratch.octree_copy, scratch.upper_copy);
  // Up to wait_for_launch_before() nothing is read that the frame before writes.
  shapes.begin(f);
  const RingItem first(GridPlaces{}, f);
  wait_for_launch_before();

  const GridTeam grid(f.barrier);
  mark_begin(grid, f.outcome);
  const bool is_needed = integrate_and_find_pairs(grid, f, shapes, first);
  shapes.end(f);
  if (!is_needed) return;
  SmallCounts counts = SmallCounts::unpacked(grid.sync_and_read(&scratch.tally));
  mark_end(grid, f.outcome, core::Stage::kBroad);
  shapes.end_upper();
  if (counts.pairs > f.pairs.capacity) return abort_small(grid, f, counts, 0);

  // If levels are left for the vertex stage, the confirmed pairs are not known yet, so all found pairs are taken; with
  // flat levels these are the confirmed ones.
  const bool has_levels_left = are_levels_left(f);
  const std::uint64_t confirmed =
      f.levels == core::Levels::kFlat || has_levels_left ? counts.pairs : counts.confirmed(f);
  mark_end(grid, f.outcome, core::Stage::kConfirm);
  if (confirmed > f.confirmed.capacity) return abort_small(grid, f, counts, confirmed);

  const NarrowPairs narrow{has_levels_left ? f.pairs.items : f.confirmed.items, confirmed, has_levels_left,
                           f.has_vertex_stage ? f.measured : nullptr, f.placed};
  if (f.has_vertex_stage) {
    const SmallLevels levels(f, shapes);
    const ProximityStage stage(f, shapes.headers(f), levels, narrow, scratch.proximity, shared);
    if (confirmed > 0) stage.run();
    stage.share_leftovers([&] {
      counts = SmallCounts::unpacked(grid.sync_and_read(&scratch.tally));
      return counts;
    });
  }
  mark_end(grid, f.outcome, core::Stage::kVertices);
  let_next_launch_begin();

  if (f.has_vertex_stage && blockIdx.x == gridDim.x - 1) list_measured(f, narrow, &scratch.listed);
  if (blockIdx.x == 0) resolve_small(f, narrow, counts, scratch, shared);
}

}  // namespace broadside::gpu
