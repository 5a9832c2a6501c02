// States and points as the trace has them, written beside the frame by a launch without barriers. Points come in the
// order in which threads find a place.
#pragma once

#include "core/method/rigid/told_point.hpp"
#include "gpu/rigid/told_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

__device__ inline ToldBody told_body(const core::RigidState& s, const core::RigidMass& mass, core::Vec3 static_spin) {
  return {core::mesh_origin(mass, s), s.q, s.v,
          mass.inverse_mass > 0.0F ? core::angular_velocity(mass, s) : static_spin};
}

__device__ inline void run_told(const ToldView& view) {
  const GridPlaces grid;
  for (std::uint64_t i = grid.rank(); i < view.body_count; i += grid.size())
    view.bodies[i] = told_body(view.state[i], view.mass[i], view.static_spin[i]);
  for (std::uint64_t k = grid.rank(); k < view.patch_count; k += grid.size()) {
    const core::ContactPatch patch = view.patches[k];
    for (int point = 0; point < patch.manifold.count; ++point) {
      const core::Vec3 impulse = view.impulses[4 * k + static_cast<std::uint64_t>(point)];
      core::ContactPoint told;
      if (core::told_point(patch, point, impulse, view.detected[patch.a].x, told))
        view.points[atomicAdd(view.point_count, 1U)] = told;
    }
  }
}

}  // namespace broadside::gpu
