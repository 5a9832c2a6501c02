// A frame of turning bodies behind its boxes and candidate pairs, up to its patches of contact. RIGID 8; the twin is
// reference/octree_cpu/rigid/rigid_pipeline.cpp.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/frame_end.cuh"
#include "gpu/stages/rigid/oriented_stage.cuh"
#include "gpu/stages/rigid/patch_stage.cuh"

namespace broadside::gpu {

__device__ inline void run_contacts(const RigidFrameView& f) {
  const GridTeam grid(f.barrier);
  mark(f, grid.rank() == 0, core::Stage::kBroad);
  if (lacks_pairs(f)) return;
  for (std::uint64_t i = grid.rank(); i < f.body_count; i += grid.size()) f.memory.count[i] = 0;
  begin_bodies(grid, f);
  confirm_pairs(grid, f);
  grid.sync();
  mark(f, grid.rank() == 0, core::Stage::kConfirm);
  if (f.counts->confirmed > f.confirmed.capacity) return;
  make_patches(grid, f);
}

}  // namespace broadside::gpu
