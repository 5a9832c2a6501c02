// The part of a frame of turning bodies that makes constraints of its patches, in the order of their colors.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/color_stage.cuh"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/frame_end.cuh"
#include "gpu/stages/rigid/list_stage.cuh"

namespace broadside::gpu {

__device__ inline void run_constraints(const RigidFrameView& f) {
  const GridTeam grid(f.barrier);
  const bool is_first = grid.rank() == 0;
  mark(f, is_first, core::Stage::kVertices);
  if (lacks_room(f)) return;
  begin_lists(grid, f);
  grid.sync();
  fill_lists(grid, f);
  grid.sync();
  rank_patches(grid, f);
  grid.sync();
  color_patches(grid, f);
  grid.sync();
  if (f.counts->colors > f.color_capacity) return;
  count_colors(grid, f);
  grid.sync();
  if (is_first) place_colors(f);
  grid.sync();
  if (f.counts->places > f.place_capacity) return;
  place_patches(grid, f);
  grid.sync();
  make_constraints(grid, f);
}

}  // namespace broadside::gpu
