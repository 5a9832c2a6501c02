// Takes back the impulses that pushed patches apart within a substep: core/method/rigid/pushed_apart.hpp.
#pragma once

#include "core/method/rigid/pushed_apart.hpp"
#include "gpu/stages/rigid/kept_impulses.cuh"
#include "gpu/stages/rigid/sweeps.cuh"

namespace broadside::gpu {

// Patches that are pushed return to the impulses with which the substep began, and stir their bodies for sweep `sweep`.
__device__ __forceinline__ void take_back_impulses(const SolveTeam& team, const RigidFrameView& f,
                                                   std::uint32_t sweep) {
  each_place(team, f, [&](const TileSlot& slot, std::uint64_t /*place*/) {
    core::PatchImpulsesBefore before;
    if (!load_before_push(slot, before)) return;
    core::PatchConstraint c;
    load_bodies(slot, c);
    load_impulses(slot, c);
    core::go_back_to(before, c);
    store_impulses(slot, c);
    stir(f, c.a, sweep);
    stir(f, c.b, sweep);
  });
}

// Sets a moved body back to the velocity that it had in the substep before any impulse, and applies the impulses that
// its patches have now. Call after a barrier.
__device__ __forceinline__ void go_back_to_start(const SolveTeam& team, const RigidFrameView& f, std::uint32_t i,
                                                 core::SolverBody& body) {
  const PackedStart& start = f.starts[i];
  if (core::is_moved(body)) {
    body.v = start.driven_v.v;
    body.angular_momentum = start.driven_angular_momentum.v;
  }
  give_present_impulses(team, f, i, body);
}

// Call after relaxation: patches that bounce stir their bodies for sweep `sweep`. Contributes their fastest approach.
__device__ __forceinline__ void stir_what_bounces(const SolveTeam& team, const RigidFrameView& f, std::uint32_t sweep,
                                                  const TeamSums& sums) {
  float fastest = 0.0F;
  each_place(team, f, [&](const TileSlot& slot, std::uint64_t /*place*/) {
    core::PatchConstraint c;
    load_directions(slot, c);
    if (!(c.surface.restitution > 0.0F)) return;
    load_bodies(slot, c);
    load_impulses(slot, c);
    load_impact(slot, c);
    const float own = core::fastest_bounce(c);
    if (!(own > 0.0F)) return;
    fastest = fmaxf(fastest, own);
    stir(f, c.a, sweep);
    stir(f, c.b, sweep);
  });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, fastest);
}

}  // namespace broadside::gpu
