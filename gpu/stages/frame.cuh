// A whole frame, as the threads of one launch run it. Counts are read after barriers, so all threads decide alike.
#pragma once

#include "gpu/frame_kernel.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/arrival_stage.cuh"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/broad_stage.cuh"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/contact_stage.cuh"
#include "gpu/stages/few_stage.cuh"
#include "gpu/stages/order_stage.cuh"
#include "gpu/stages/proximity_stage.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Up to this many confirmed pairs, of bodies that fit its shared memory, one block resolves alone: its threads see each
// other's writes in some 30 ns, those of the grid in some 700.
constexpr std::uint64_t kOneBlockPairs = 8192;

// Whether all contacts are resolved by a thread for each body; few: has_few_bodies, and nothing else that they do not
// need.
enum class FrameKind : std::uint8_t { kFew, kSome, kMany };

// For so many threads of the grid.
inline FrameKind kind_of(const FrameView& f, std::uint64_t threads) {
  if (has_few_bodies(f, threads)) return FrameKind::kFew;
  return f.body_count <= threads ? FrameKind::kSome : FrameKind::kMany;
}

template <typename Team>
__device__ void mark(const Team& team, const FrameView& f, int stage) {
  if (team.rank() == 0) f.outcome->stage_end_ns[stage] = now_ns();
}

template <FrameKind kKind, typename Team>
__device__ void report(const Team& team, const FrameView& f, bool is_aborted) {
  if (team.rank() != 0) return;
  if constexpr (kKind == FrameKind::kFew) {
    const FewCounts counts = FewCounts::unpacked(f.counters->few);
    f.counters->pairs = counts.pairs;
    f.counters->confirmed = counts.confirmed;
  }
  f.counters->is_aborted = is_aborted ? 1 : 0;
  f.outcome->counters = *f.counters;
}

// Contacts, faces and the report: what a single block does alone when it is little.
template <FrameKind kKind, typename Team, typename Live>
__device__ void resolve(const Team& team, const FrameView& f, std::uint64_t confirmed, const Live& live) {
  constexpr bool kIsFew = kKind == FrameKind::kFew;
  collect_touching(team, f, confirmed);
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
  mark(team, f, 5);
  resolve_faces(team, f);
  team.sync();
  mark(team, f, 6);
  report<kKind>(team, f, f.counters->faces > f.face_contacts.capacity);
}

// What a block has in shared memory beside `shared`.
struct BlockScratch {
  ProximityScratch proximity;
  BlockCopy copy;
};

// `shared`: what LaunchShape says, a block's own. Each kind is a kernel of its own, because what is left out there
// leaves registers and instruction cache to the rest. Always inlined: a call would take the view through memory.
template <FrameKind kKind>
__device__ __forceinline__ void run_frame(const FrameView& f, BlockScratch& scratch, unsigned char* shared) {
  constexpr bool kIsFew = kKind == FrameKind::kFew;
  const GridTeam grid(f.barrier);
  mark(grid, f, 0);
  const bool starts_at_level0 = kIsFew || f.broad.start != Start::kNone;
  if constexpr (kIsFew) {
    const OctreesInBlock octrees(f, shared, scratch.copy);
    const bool is_needed = integrate(grid, f);
    octrees.begin(f);
    const FewStart start(grid, f);
    if (is_needed) grid.sync();
    octrees.end();
    if (!is_needed) return;
    mark(grid, f, 1);
    if (octrees.are_there())
      find_and_confirm_few(grid, f, start, octrees);
    else
      find_and_confirm_few(grid, f, start, OctreesInMemory{f.shapes.octree});
  } else {
    if (!integrate(grid, f)) return;
    grid.sync();
    mark(grid, f, 1);
    if (starts_at_level0) {
      PairQueue& queue = reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32];
      if (!find_candidates(grid, f.broad, f.boxes, f.body_count, f.pairs, f.counters, queue, nullptr))
        return report<kKind>(grid, f, true);
    } else {
      Uncounted work;
      confirm_by_brute_force(grid, f, work);
    }
  }
  grid.sync();
  mark(grid, f, 2);
  const FewCounts few = FewCounts::unpacked(kIsFew ? f.counters->few : 0ULL);
  const std::uint64_t pairs = kIsFew ? few.pairs : f.counters->pairs;
  if (pairs > f.pairs.capacity) return report<kKind>(grid, f, true);

  // From level 0 alone, what was found is what is confirmed.
  const bool is_confirmed_by_level0 = starts_at_level0 && f.levels == core::Levels::kFlat;
  if (!kIsFew && starts_at_level0 && !is_confirmed_by_level0) {
    Uncounted work;
    confirm_pairs(grid, f, work);
    grid.sync();
  }
  const std::uint64_t confirmed =
      is_confirmed_by_level0 ? pairs : (kIsFew ? std::uint64_t{few.confirmed} : f.counters->confirmed);
  mark(grid, f, 3);
  if (confirmed > f.confirmed.capacity) return report<kKind>(grid, f, true);

  if (f.has_vertex_stage && confirmed > 0) {
    measure_proximity(f, confirmed, scratch.proximity, shared);
    grid.sync();
  }
  mark(grid, f, 4);

  if constexpr (kKind != FrameKind::kMany) {
    if (confirmed <= kOneBlockPairs && f.body_count <= f.block_bodies) {
      if (blockIdx.x == 0) resolve<kKind>(BlockTeam{}, f, confirmed, BlockLive{reinterpret_cast<LiveBody*>(shared)});
      return;
    }
  }
  // No more blocks than there is work for: fewer meet sooner. Up to half of the grid, a body a warp is work enough: a
  // chain of contacts waits longer in warps where other threads resolve theirs.
  const std::uint64_t work = max(confirmed, std::uint64_t{f.body_count});
  const std::uint64_t lonely = min(std::uint64_t{gridDim.x} / 2, std::uint64_t{f.body_count} * 32 / blockDim.x);
  const std::uint64_t blocks = min(std::uint64_t{gridDim.x}, max(lonely, (work + blockDim.x - 1) / blockDim.x));
  if (blockIdx.x >= blocks) return;
  resolve<kKind>(PartialGridTeam{static_cast<std::uint32_t>(blocks), &f.counters->arrived}, f, confirmed,
                 GridLive{f.live});
}

}  // namespace broadside::gpu
