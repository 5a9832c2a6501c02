// The part of a frame of turning bodies from its candidate pairs to its patches of contact. RIGID 8; the twin is
// reference/octree_cpu/rigid/rigid_pipeline.cpp.
#pragma once

#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/frame_marks.cuh"
#include "gpu/stages/rigid/oriented_stage.cuh"
#include "gpu/stages/rigid/patch_stage.cuh"

namespace broadside::gpu {

// Returns false if the frame will be repeated, so that no patches are to be made.
template <typename Team>
__device__ bool confirm_first(const Team& grid, const ContactView& f) {
  mark(f, grid.rank() == 0, core::Stage::kBroad);
  if (lacks_pairs(f)) return false;
  confirm_pairs(grid, f);
  grid.sync();
  mark(f, grid.rank() == 0, core::Stage::kConfirm);
  return f.counts->confirmed <= f.confirmed.capacity;
}

// All patches, where no shape is a hull or a mesh and no body is swept.
__device__ inline void run_short_contacts(const ContactView& f) {
  const GridTeam grid(f.barrier);
  if (confirm_first(grid, f)) make_short_patches(grid, f);
}

// Otherwise this is run first, which has no code of shapes except boxes and hulls, and then run_long_contacts.
__device__ inline void run_near_contacts(const ContactView& f) {
  const GridTeam grid(f.barrier);
  if (!confirm_first(grid, f)) return;
  if (f.fresh != nullptr) {
    carry_patches(grid, f);
    grid.sync();
  }
  list_near_pairs<core::OneLane>(grid, f);
  grid.sync();
  make_hull_patches(grid, f);
  make_face_patches_of_hulls(grid, f);
}

__device__ inline void run_long_contacts(const ContactView& f) {
  if (lacks_pairs(f) || f.counts->confirmed > f.confirmed.capacity) return;
  make_long_patches(GridPlaces{}, f);
}

}  // namespace broadside::gpu
