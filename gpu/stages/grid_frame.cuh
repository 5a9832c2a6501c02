// A grid frame from top to bottom, as the threads of one launch run it: METHOD sections 1 to 6. Counts are read after
// barriers, so all threads take the same branches.
#pragma once

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/grid_frame_view.hpp"
#include "gpu/stages/broad/broad_stage.cuh"
#include "gpu/stages/frame_report.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/confirm_stage.cuh"
#include "gpu/stages/response/arrival_stage.cuh"
#include "gpu/stages/response/frame_response.cuh"
#include "gpu/stages/vertices/proximity_stage.cuh"

namespace broadside::gpu {

// One block resolves up to this many confirmed pairs, if their bodies fit its shared memory: threads of a block see
// each other's writes after some 30 ns, threads of the grid after some 700.
constexpr std::uint64_t kOneBlockPairs = 8192;

// What a block has in shared memory in addition to `shared`.
struct GridScratch {
  ProximityScratch proximity;
  Counters counters;
};

// Called by all threads if there is not enough room for the confirmed pairs, or for what the counters say.
__device__ inline void abort_grid(const FrameView& f, std::uint64_t confirmed) {
  if (blockIdx.x != 0 || threadIdx.x != 0) return;
  Counters counters = *f.counters;
  counters.confirmed = max(std::uint64_t{counters.confirmed}, confirmed);
  tell_host(f, counters, true);
}

// Resolves contacts and faces, by all threads of a team. kHasThreadPerBody: the team has a thread for each body;
// otherwise a contact that is resolved hands its bodies on to their next contacts.
template <bool kHasThreadPerBody, typename Team, typename Live>
__device__ void resolve_grid(const Team& team, const FrameView& f, const NarrowPairs& pairs, const Live& live) {
  resolve_by_team(team, f, pairs, [&](std::uint64_t count) {
    if (f.solver == Solver::kRacing) {
      resolve_racing(team, f, count);
    } else if (f.solver == Solver::kJacobi) {
      list_contacts<false>(team, f, count);
      resolve_jacobi(team, f, count);
    } else if constexpr (kHasThreadPerBody) {
      resolve_body_by_body(team, f, count, live);
    } else {
      start_live(team, f, live);
      list_contacts<true>(team, f, count);
      resolve_by_arrival(team, f, count, live);
      team.sync();
      finish_live(team, f, live);
    }
  });
  if (team.rank() == 0) tell_host(f, *f.counters, !has_room_for_faces(f, *f.counters));
}

// The same by one block, if that has room; otherwise it does nothing and returns false. Called by all threads of the
// grid.
__device__ inline bool resolve_by_one_block(const FrameView& f, const NarrowPairs& pairs, Counters& counters,
                                            unsigned char* shared) {
  if (f.solver == Solver::kColored && BlockRoom::fits(f, pairs.count)) {
    if (blockIdx.x != 0) return true;
    if (threadIdx.x == 0) counters = *f.counters;
    resolve_alone(f, pairs, BlockRoom(shared, f.body_count, static_cast<std::uint32_t>(pairs.count)), counters);
    if (threadIdx.x == 0) tell_host(f, counters, !has_room_for_faces(f, counters));
    return true;
  }
  if (pairs.count > kOneBlockPairs || f.body_count > f.block_bodies) return false;
  if (blockIdx.x == 0) resolve_grid<true>(BlockTeam{}, f, pairs, BlockLive{reinterpret_cast<LiveBody*>(shared)});
  return true;
}

// The same by the first blocks of the grid. There are no more of them than there is work for, because a barrier of
// fewer blocks is faster. But up to half of the grid, each warp gets only one body: a chain of contacts takes longer if
// other threads of its warps resolve contacts of their own.
template <bool kHasThreadPerBody>
__device__ void resolve_by_blocks(const GridFrameView& f, const NarrowPairs& pairs) {
  const std::uint64_t work = max(pairs.count, std::uint64_t{f.body_count});
  const std::uint64_t lonely = min(std::uint64_t{gridDim.x} / 2, std::uint64_t{f.body_count} * 32 / blockDim.x);
  const std::uint64_t blocks = min(std::uint64_t{gridDim.x}, max(lonely, (work + blockDim.x - 1) / blockDim.x));
  if (blockIdx.x >= blocks) return;
  const PartialGridTeam team{static_cast<std::uint32_t>(blocks), &f.counters->arrived};
  resolve_grid<kHasThreadPerBody>(team, f, pairs, GridLive{f.live});
}

// `shared`: the block's shared memory, as large as LaunchShape says. kHasThreadPerBody: the grid has a thread for each
// body. Always inlined, because a call would pass the view through memory.
template <bool kHasThreadPerBody>
__device__ __forceinline__ void run_grid_frame(const GridFrameView& f, GridScratch& scratch, unsigned char* shared) {
  const GridTeam grid(f.barrier);
  mark_begin(grid, f.outcome);
  if (!integrate(grid, f)) return;
  grid.sync();
  mark_end(grid, f.outcome, core::Stage::kIntegrate);

  const bool starts_at_level0 = f.broad.start != Start::kNone;
  if (starts_at_level0) {
    PairQueue& queue = reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32];
    if (!find_candidates(grid, f.broad, f.boxes, f.body_count, f.pairs, f.counters, queue, nullptr))
      return abort_grid(f, 0);
  } else {
    Uncounted work;
    confirm_by_brute_force(grid, f, work);
  }
  grid.sync();
  mark_end(grid, f.outcome, core::Stage::kBroad);
  if (f.counters->pairs > f.pairs.capacity) return abort_grid(f, 0);

  // With level 0 alone, the pairs that were found are the confirmed ones.
  const bool is_confirmed_by_level0 = starts_at_level0 && f.levels == core::Levels::kFlat;
  if (starts_at_level0 && !is_confirmed_by_level0) {
    Uncounted work;
    confirm_pairs(grid, f, work);
    grid.sync();
  }
  const std::uint64_t confirmed = is_confirmed_by_level0 ? f.counters->pairs : f.counters->confirmed;
  mark_end(grid, f.outcome, core::Stage::kConfirm);
  if (confirmed > f.confirmed.capacity) return abort_grid(f, confirmed);

  const NarrowPairs narrow{f.confirmed.items, confirmed};
  if (f.has_vertex_stage && confirmed > 0) {
    const ShapeHeaders headers{f.shapes.trees, f.shapes.near_cells, f.shapes.tree_upper, nullptr};
    ProximityStage(f, headers, NoLevels{}, narrow, scratch.proximity, shared).run();
    grid.sync();
  }
  mark_end(grid, f.outcome, core::Stage::kVertices);

  if constexpr (kHasThreadPerBody)
    if (resolve_by_one_block(f, narrow, scratch.counters, shared)) return;
  resolve_by_blocks<kHasThreadPerBody>(f, narrow);
}

}  // namespace broadside::gpu
