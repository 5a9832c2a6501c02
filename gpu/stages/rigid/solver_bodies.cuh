// Bodies in memory while their contacts are solved.
#pragma once

#include "core/method/rigid/solver_body.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// Without the orientation, which no contact reads.
__device__ __forceinline__ core::SolverBody load_moving(const PackedSolverBody& from) {
  const PackedVec3 v = from.v;
  const PackedVec3 momentum = from.angular_momentum;
  const PackedVec3 inertia = from.inertia;
  const PackedVec3 moved = from.moved;
  const PackedVec3 turned = from.turned;
  core::SolverBody b;
  b.v = v.v;
  b.inverse_mass = v.w;
  b.angular_momentum = momentum.v;
  b.inverse_inertia = {momentum.w, inertia.v.x, inertia.v.y, inertia.v.z, inertia.w, moved.w};
  b.moved = moved.v;
  b.turned = turned.v;
  return b;
}

__device__ inline core::SolverBody load_body(const PackedSolverBody& from) {
  core::SolverBody b = load_moving(from);
  b.orientation = {from.q, from.q_rest};
  return b;
}

// What a contact changes.
__device__ inline void store_velocity(PackedSolverBody& to, const core::SolverBody& b) {
  if (!core::is_moved(b)) return;
  to.v = {b.v, b.inverse_mass};
  to.angular_momentum = {b.angular_momentum, b.inverse_inertia.xx};
}

__device__ inline void store_body(PackedSolverBody& to, const core::SolverBody& b) {
  to.v = {b.v, b.inverse_mass};
  to.angular_momentum = {b.angular_momentum, b.inverse_inertia.xx};
  to.inertia = {{b.inverse_inertia.yy, b.inverse_inertia.zz, b.inverse_inertia.xy}, b.inverse_inertia.xz};
  to.moved = {b.moved, b.inverse_inertia.yz};
  to.turned = {b.turned, 0.0F};
  to.q = b.orientation.q;
  to.q_rest = b.orientation.rest;
}

}  // namespace broadside::gpu
