// The end of a frame of turning bodies: contacts are solved while the bodies move.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/frame_end.cuh"
#include "gpu/stages/rigid/solve_stage.cuh"
#include "gpu/stages/rigid/solve_team.cuh"

namespace broadside::gpu {

// constraints: f.constraints, whose layout the caller may know when it is compiled. shared: in the block's shared
// memory.
__device__ __forceinline__ void run_solve(const RigidFrameView& f, const ConstraintMemory& constraints,
                                          SolveShared& shared) {
  const SolveTeam team(f, constraints, shared);
  const bool is_first = team.rank() == 0;
  const bool is_aborted = lacks_room(f);
  if (!is_aborted) {
    run_substeps(team, f);
    finish_bodies(team, f);
    finish_patches(team, f);
  }
  team.sync();
  if (!is_first) return;
  // Contacts with faces are solved together with all others.
  mark(f, true, core::Stage::kResponse);
  mark(f, true, core::Stage::kFaces);
  tell_host(f, is_aborted);
}

}  // namespace broadside::gpu
