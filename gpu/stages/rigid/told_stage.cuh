// Writes states and points as the trace has them, beside the frame, in a launch without barriers. Points are in the
// order in which threads find a place for them.
#pragma once

#include "core/contact_point.hpp"
#include "core/method/rigid/told_point.hpp"
#include "gpu/rigid/told_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

__device__ inline void tell_body(const ToldView& view, std::uint64_t i) {
  const core::RigidState& s = view.state[i];
  const core::RigidMass& mass = view.mass[i];
  view.bodies.position[i] = core::mesh_origin(mass, s);
  view.bodies.orientation[i] = s.q;
  view.bodies.velocity[i] = s.v;
  view.bodies.angular_velocity[i] = mass.inverse_mass > 0.0F ? core::angular_velocity(mass, s) : view.static_spin[i];
}

__device__ inline void tell_point(const ToldPoints& to, std::uint32_t row, const core::ContactPoint& told) {
  to.a[row] = told.a;
  to.b[row] = told.b;
  to.point[row] = told.point;
  to.normal[row] = told.normal;
  to.gap_m[row] = told.gap_m;
  to.impulse[row] = told.impulse;
  to.feature[row] = told.feature;
}

// The last block that ends tells the host how many points there are, which costs neither a copy nor a second launch.
__device__ inline void tell_point_count(const ToldView& view) {
  __syncthreads();
  if (threadIdx.x != 0) return;
  __threadfence();
  if (atomicAdd(view.blocks_done, 1U) + 1 < gridDim.x) return;
  *view.told_points = atomicAdd(view.point_count, 0U);
  *view.point_count = 0;
  *view.blocks_done = 0;
}

__device__ inline void run_told(const ToldView& view) {
  const GridPlaces grid;
  for (std::uint64_t i = grid.rank(); i < view.body_count; i += grid.size()) tell_body(view, i);
  for (std::uint64_t k = grid.rank(); k < view.patch_count; k += grid.size()) {
    const core::ContactPatch patch = view.patches[k];
    for (int point = 0; point < patch.manifold.count; ++point) {
      const core::Vec3 impulse = view.impulses[4 * k + static_cast<std::uint64_t>(point)];
      core::ContactPoint told;
      if (core::told_point(patch, point, impulse, view.detected[patch.a].x, told))
        tell_point(view.points, atomicAdd(view.point_count, 1U), told);
    }
  }
  tell_point_count(view);
}

}  // namespace broadside::gpu
