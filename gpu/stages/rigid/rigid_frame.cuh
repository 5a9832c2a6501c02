// A frame of turning bodies behind its boxes and candidate pairs, from top to bottom. RIGID 8; the twin is
// reference/octree_cpu/rigid/rigid_pipeline.cpp.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/color_stage.cuh"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/oriented_stage.cuh"
#include "gpu/stages/rigid/patch_stage.cuh"
#include "gpu/stages/rigid/solve_stage.cuh"

namespace broadside::gpu {

// By one thread. Of an aborted frame the counts say what it needed. Leaves zeros for the next frame.
__device__ inline void tell_host(const RigidFrameView& f, bool is_aborted) {
  RigidCounts counts = *f.counts;
  counts.is_aborted = is_aborted ? 1 : 0;
  f.outcome->counts = counts;
  RigidCounts next;
  next.arrived = counts.arrived;  // others may still wait for it; the next place kernel clears it
  *f.counts = next;
  for (std::uint32_t color = 0; color < counts.colors && color < f.color_capacity; ++color) f.color_count[color] = 0;
}

__device__ inline void mark(const RigidFrameView& f, bool is_first, core::Stage ended) {
  if (is_first) f.outcome->stage_end_ns[static_cast<std::size_t>(ended)] = now_ns();
}

// The broad phase aborted, or its cells were made for smaller boxes.
__device__ inline bool lacks_pairs(const RigidFrameView& f) {
  return f.counts->largest_side > f.side_limit || f.counts->largest_coordinate > f.coordinate_limit ||
         (f.has_broad && f.broad_counters->is_aborted != 0);
}

// The first blocks of the grid, or one: one class for both, because the sweeps are long to compile.
class SolvingTeam {
 public:
  __device__ SolvingTeam(std::uint32_t blocks, std::uint32_t* arrived) : blocks_{blocks, arrived} {}

  __device__ std::uint64_t rank() const { return blocks_.rank(); }
  __device__ std::uint64_t size() const { return blocks_.size(); }
  __device__ void sync() const {
    if (blocks_.blocks == 1)
      __syncthreads();
    else
      blocks_.sync();
  }

 private:
  PartialGridTeam blocks_;
};

template <typename Team>
__device__ void solve_and_finish(const Team& team, const RigidFrameView& f) {
  run_substeps(team, f);
  finish_bodies(team, f);
  finish_patches(team, f);
  team.sync();
  if (team.rank() != 0) return;
  mark(f, true, core::Stage::kResponse);
  mark(f, true, core::Stage::kFaces);
  tell_host(f, false);
}

// Patches of a color that a block takes at once. Few blocks have a fast barrier; a block with few warps waits for
// memory.
constexpr std::uint32_t kPatchesOfBlock = 128;

__device__ inline std::uint32_t solving_blocks(const RigidFrameView& f) {
  const std::uint32_t colors = max(1U, f.counts->colors);
  const auto patches = static_cast<std::uint32_t>(f.counts->patches);
  const std::uint32_t wanted = (max(patches / colors, f.body_count / 4) + kPatchesOfBlock - 1) / kPatchesOfBlock;
  return min(gridDim.x, max(1U, wanted));
}

__device__ inline void run_rigid_frame(const RigidFrameView& f) {
  const GridTeam grid(f.barrier);
  const bool is_first = grid.rank() == 0;
  mark(f, is_first, core::Stage::kBroad);
  if (lacks_pairs(f)) {
    grid.sync();  // all have read the counts
    if (is_first) tell_host(f, true);
    return;
  }
  for (std::uint64_t i = grid.rank(); i < f.body_count; i += grid.size()) f.memory.count[i] = 0;
  begin_bodies(grid, f);
  confirm_pairs(grid, f);
  grid.sync();
  mark(f, is_first, core::Stage::kConfirm);
  if (f.counts->confirmed > f.confirmed.capacity) {
    grid.sync();
    if (is_first) tell_host(f, true);
    return;
  }
  make_patches(grid, f);
  grid.sync();
  mark(f, is_first, core::Stage::kVertices);
  if (f.counts->patches > f.patches.capacity) {
    grid.sync();
    if (is_first) tell_host(f, true);
    return;
  }
  begin_lists(grid, f);
  grid.sync();
  fill_lists(grid, f);
  grid.sync();
  rank_patches(grid, f);
  grid.sync();
  color_patches(grid, f);
  const bool has_color_room = f.counts->colors <= f.color_capacity;
  if (has_color_room && is_first) place_colors(f);
  grid.sync();
  if (!has_color_room || f.counts->places > f.place_capacity) {
    grid.sync();
    if (is_first) tell_host(f, true);
    return;
  }
  place_patches(grid, f);
  grid.sync();
  make_constraints(grid, f);
  grid.sync();
  const std::uint32_t blocks = solving_blocks(f);
  if (blockIdx.x < blocks) solve_and_finish(SolvingTeam(blocks, &f.counts->arrived), f);
}

}  // namespace broadside::gpu
