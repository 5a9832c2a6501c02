// The digest of a frame of turning bodies: the sum that the twin adds up. A launch of its own, made when a digest is
// asked for.
#pragma once

#include "core/method/frame_digest.hpp"
#include "core/method/rigid/point_digest.hpp"
#include "core/method/rigid/told_point.hpp"
#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

__device__ inline void run_rigid_digest(const RigidDigestView& view) {
  const GridPlaces grid;
  unsigned long long sum = 0;
  for (std::uint64_t k = grid.rank(); k < view.body_count; k += grid.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    const core::RigidState s = view.state[i];
    const core::RigidMass mass = view.mass[i];
    const core::Vec3 spin = mass.inverse_mass > 0.0F ? core::angular_velocity(mass, s) : view.static_spin[i];
    sum += core::body_digest(i, core::mesh_origin(mass, s), s.q, s.v, spin);
  }
  for (std::uint64_t k = grid.rank(); k < view.confirmed_count; k += grid.size())
    sum += core::confirmed_digest(view.confirmed[k]);
  for (std::uint64_t k = grid.rank(); k < view.patch_count; k += grid.size()) {
    const core::ContactPatch patch = view.patches[k];
    for (int point = 0; point < patch.manifold.count; ++point) {
      core::ContactPoint told;
      if (core::told_point(patch, point, view.impulses[4 * k + static_cast<std::uint64_t>(point)],
                           view.detected[patch.a].x, told))
        sum += core::point_digest(told);
    }
  }
  for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(kFullWarp, sum, step);
  if (lane() == 0 && sum != 0) atomicAdd(view.digest, sum);
}

}  // namespace broadside::gpu
