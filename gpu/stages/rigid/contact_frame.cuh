// The part of a frame of turning bodies from its candidate pairs to its patches of contact. RIGID 8; the twin is
// reference/octree_cpu/rigid/rigid_pipeline.cpp.
#pragma once

#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/frame_marks.cuh"
#include "gpu/stages/rigid/oriented_stage.cuh"
#include "gpu/stages/rigid/patch_stage.cuh"

namespace broadside::gpu {

// kMayBeLong: shapes may be hulls or meshes (f.has_long_contacts), or ways are followed (f.follows_ways).
template <bool kMayBeLong>
__device__ void run_contacts(const ContactView& f) {
  const GridTeam grid(f.barrier);
  mark(f, grid.rank() == 0, core::Stage::kBroad);
  if (lacks_pairs(f)) return;
  confirm_pairs(grid, f);
  grid.sync();
  mark(f, grid.rank() == 0, core::Stage::kConfirm);
  if (f.counts->confirmed > f.confirmed.capacity) return;
  if constexpr (kMayBeLong)
    make_long_patches(grid, f);
  else
    make_short_patches(grid, f);
}

}  // namespace broadside::gpu
