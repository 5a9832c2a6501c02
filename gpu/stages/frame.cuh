// A whole frame, as the threads of one launch run it. Counts are read after barriers, so all threads decide alike.
#pragma once

#include <variant>

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/broad/broad_stage.cuh"
#include "gpu/stages/broad/few_stage.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/confirm_stage.cuh"
#include "gpu/stages/response/arrival_stage.cuh"
#include "gpu/stages/response/block_stage.cuh"
#include "gpu/stages/response/contact_stage.cuh"
#include "gpu/stages/response/order_stage.cuh"
#include "gpu/stages/vertices/proximity_stage.cuh"

namespace broadside::gpu {

// Up to this many confirmed pairs, of bodies that fit its shared memory, one block resolves alone, and few bodies' in
// any number: its threads see each other's writes in some 30 ns, those of the grid in some 700.
constexpr std::uint64_t kOneBlockPairs = 8192;

// Whether all contacts are resolved by a thread for each body; few: has_few_bodies, and nothing else that they do not
// need.
enum class FrameKind : std::uint8_t { kFew, kSome, kMany };

// For so many threads of the grid.
inline FrameKind kind_of(const FrameView& f, std::uint64_t threads) {
  if (has_few_bodies(f)) return FrameKind::kFew;
  return f.body_count <= threads ? FrameKind::kSome : FrameKind::kMany;
}

// By one thread, when nobody adds to the tally any more, which is cleared for the next frame.
__device__ inline void report(const FrameView& f, Counters counters, const FewCounts& few, bool is_aborted) {
  f.barrier[1] = 0;
  *f.given_out = 0;
  counters.is_aborted = is_aborted ? 1 : 0;
  *f.counters = counters;
  f.outcome->counters = counters;
  if (const unsigned long long tally = few.packed(); tally != 0) atomicAdd(f.barrier, 0ULL - tally);
}

// What is counted so far. Few bodies' counters are clear until their frame is reported.
template <FrameKind kKind>
__device__ Counters counters_of(const FrameView& f, const FewCounts& few) {
  if constexpr (kKind == FrameKind::kFew) {
    Counters counters;
    counters.pairs = few.pairs;
    counters.confirmed = few.confirmed(f);
    return counters;
  } else {
    return *f.counters;
  }
}

// For want of room for so many confirmed pairs, if that is known. By all threads.
template <FrameKind kKind>
__device__ void report_aborted(const GridTeam& grid, const FrameView& f, const FewCounts& few = {},
                               std::uint64_t confirmed = 0) {
  // The tally is cleared when all have seen it: who did not would go on, and wait for the others.
  if constexpr (kKind == FrameKind::kFew) grid.sync();
  if (blockIdx.x != 0 || threadIdx.x != 0) return;
  Counters counters = counters_of<kKind>(f, few);
  counters.confirmed = max(std::uint64_t{counters.confirmed}, confirmed);
  report(f, counters, few, true);
}

// Contacts, faces and the report: what a single block does alone when it is little.
template <FrameKind kKind, typename Team, typename Live>
__device__ void resolve(const Team& team, const FrameView& f, const MeetingPairs& pairs, const FewCounts& few,
                        const Live& live) {
  constexpr bool kIsFew = kKind == FrameKind::kFew;
  collect_touching(team, f, pairs);
  team.sync();
  const std::uint64_t count = f.counters->touching;
  if (!kIsFew && count > 0 && f.solver == Solver::kRacing) {
    resolve_racing(team, f, count);
  } else if (!kIsFew && count > 0 && f.solver == Solver::kJacobi) {
    list_contacts<false>(team, f, count);
    resolve_jacobi(team, f, count);
  } else if (count > 0) {
    start_live(team, f, live);
    list_contacts<kKind == FrameKind::kMany>(team, f, count);
    if constexpr (kKind == FrameKind::kMany)
      resolve_by_arrival(team, f, count, live);
    else
      resolve_by_looking(team, f, live);
    team.sync();
    finish_live(team, f, live);
  }
  mark_end(team, f.outcome, core::Stage::kResponse);
  resolve_faces(team, f);
  team.sync();
  mark_end(team, f.outcome, core::Stage::kFaces);
  if (team.rank() != 0) return;
  Counters counters = *f.counters;
  if constexpr (kIsFew) {
    counters.pairs = few.pairs;
    counters.confirmed = few.confirmed(f);
  }
  report(f, counters, few, counters.faces > f.face_contacts.capacity);
}

// The same by one block that has room for it. `counters`: in its shared memory, because there are no registers for
// them.
template <FrameKind kKind>
__device__ void resolve_alone(const FrameView& f, const MeetingPairs& pairs, const FewCounts& few,
                              const BlockRoom& room, Counters& counters) {
  const BlockTeam team;
  if (team.rank() == 0) counters = counters_of<kKind>(f, few);
  resolve_in_block(f, pairs, room, [&] { mark_end(team, f.outcome, core::Stage::kResponse); });
  mark_end(team, f.outcome, core::Stage::kFaces);
  if (team.rank() != 0) return;
  counters.touching = room.counts->touching;
  counters.faces = room.counts->faces;
  counters.colors = room.counts->colors;
  report(f, counters, few, counters.faces > f.face_contacts.capacity);
}

// The same by the first blocks of the grid.
template <FrameKind kKind>
__device__ void resolve_by_grid(const FrameView& f, const MeetingPairs& pairs, const FewCounts& few) {
  // No more blocks than there is work for: fewer meet sooner. Up to half of the grid, a body a warp is work enough: a
  // chain of contacts waits longer in warps where other threads resolve theirs.
  const std::uint64_t work = max(pairs.count, std::uint64_t{f.body_count});
  const std::uint64_t lonely = min(std::uint64_t{gridDim.x} / 2, std::uint64_t{f.body_count} * 32 / blockDim.x);
  const std::uint64_t blocks = min(std::uint64_t{gridDim.x}, max(lonely, (work + blockDim.x - 1) / blockDim.x));
  if (blockIdx.x >= blocks) return;
  resolve<kKind>(PartialGridTeam{static_cast<std::uint32_t>(blocks), &f.counters->arrived}, f, pairs, few,
                 GridLive{f.live});
}

// What a block has in shared memory beside `shared`.
struct BlockScratch {
  ProximityScratch proximity;
  BlockCopy octree_copy;
  BlockCopy upper_copy;
  GridTally tally;
  Counters counters;
  std::uint32_t listed;
};

// What can be done while the frame before ends. Returns a warp's first FewItem, of few bodies.
template <FrameKind kKind>
__device__ auto begin_frame(const FrameView& f, const ShapesInBlock& shapes, ProximityScratch& scratch) {
  if constexpr (kKind == FrameKind::kFew) {
    scratch.clear();
    shapes.begin(f);
    const FewItem first(GridPlaces{}, f);
    wait_for_launch_before();
    return first;
  } else {
    return std::monostate{};
  }
}

// `shared`: what LaunchShape says, a block's own. Each kind is a kernel of its own, because what is left out there
// leaves registers and instruction cache to the rest. Always inlined: a call would take the view through memory.
template <FrameKind kKind>
__device__ __forceinline__ void run_frame(const FrameView& f, BlockScratch& scratch, unsigned char* shared) {
  constexpr bool kIsFew = kKind == FrameKind::kFew;
  const ShapesInBlock shapes(f, shared, scratch.octree_copy, scratch.upper_copy);  // of few bodies
  const bool starts_at_level0 = kIsFew || f.broad.start != Start::kNone;
  const auto first = begin_frame<kKind>(f, shapes, scratch.proximity);
  const GridTeam grid(f.barrier);
  mark_begin(grid, f.outcome);
  if constexpr (kIsFew) {
    const bool is_needed = integrate_and_find_few(grid, f, shapes, first);
    shapes.end(f);
    if (!is_needed) return;
  } else {
    if (!integrate(grid, f)) return;
    grid.sync();
    mark_end(grid, f.outcome, core::Stage::kIntegrate);
    if (starts_at_level0) {
      PairQueue& queue = reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32];
      if (!find_candidates(grid, f.broad, f.boxes, f.body_count, f.pairs, f.counters, queue, nullptr))
        return report_aborted<kKind>(grid, f);
    } else {
      Uncounted work;
      confirm_by_brute_force(grid, f, work);
    }
  }
  FewCounts few;
  if constexpr (kIsFew) {
    // With a vertex stage they meet again before anything else of this is looked at than where a pair's bodies are.
    few = FewCounts::unpacked(grid.sync_and_ask(&scratch.tally, f.has_vertex_stage));
  } else {
    grid.sync();
  }
  mark_end(grid, f.outcome, core::Stage::kBroad);
  if constexpr (kIsFew) shapes.end_upper();
  const std::uint64_t pairs = kIsFew ? few.pairs : f.counters->pairs;
  if (pairs > f.pairs.capacity) return report_aborted<kKind>(grid, f, few);

  // From level 0 alone, what was found is what is confirmed.
  const bool is_confirmed_by_level0 = starts_at_level0 && f.levels == core::Levels::kFlat;
  if (!kIsFew && starts_at_level0 && !is_confirmed_by_level0) {
    Uncounted work;
    confirm_pairs(grid, f, work);
    grid.sync();
  }
  // Where levels are left for the vertex stage, the confirmed are among all that was found.
  const bool has_levels_left = kIsFew && are_levels_left(f);
  const std::uint64_t confirmed = is_confirmed_by_level0 || has_levels_left
                                      ? pairs
                                      : (kIsFew ? std::uint64_t{few.confirmed(f)} : f.counters->confirmed);
  mark_end(grid, f.outcome, core::Stage::kConfirm);
  if (confirmed > f.confirmed.capacity) return report_aborted<kKind>(grid, f, few, confirmed);

  const MeetingPairs meeting{has_levels_left ? f.pairs.items : f.confirmed.items, confirmed, has_levels_left,
                             kIsFew && f.has_vertex_stage ? f.measured : nullptr, kIsFew ? f.placed : nullptr};
  if (f.has_vertex_stage && (kIsFew || confirmed > 0)) {
    if constexpr (kIsFew) {
      const FewLevels levels(f, shapes);
      const ProximityStage stage(f, shapes.headers(f), levels, meeting, scratch.proximity, shared);
      if (confirmed > 0) stage.run();
      stage.share_rests([&] {
        few = FewCounts::unpacked(grid.sync_and_ask(&scratch.tally));
        return few;
      });
    } else {
      const ShapeHeaders headers{f.shapes.trees, f.shapes.near_cells, f.shapes.tree_upper, nullptr};
      ProximityStage(f, headers, NoLevels{}, meeting, scratch.proximity, shared).run();
      grid.sync();
    }
  }
  mark_end(grid, f.outcome, core::Stage::kVertices);
  if constexpr (kIsFew) let_next_launch_begin();

  if (kIsFew && f.has_vertex_stage && blockIdx.x == gridDim.x - 1) list_measured(f, meeting, &scratch.listed);
  if constexpr (kKind != FrameKind::kMany) {
    if (f.solver == Solver::kColored && BlockRoom::fits(f, confirmed)) {
      const BlockRoom room(shared, f.body_count, static_cast<std::uint32_t>(confirmed));
      if (blockIdx.x == 0) resolve_alone<kKind>(f, meeting, few, room, scratch.counters);
      return;
    }
    if (kIsFew || (confirmed <= kOneBlockPairs && f.body_count <= f.block_bodies)) {
      if (blockIdx.x == 0) resolve<kKind>(BlockTeam{}, f, meeting, few, BlockLive{reinterpret_cast<LiveBody*>(shared)});
      return;
    }
  }
  if constexpr (!kIsFew) resolve_by_grid<kKind>(f, meeting, few);
}

}  // namespace broadside::gpu
