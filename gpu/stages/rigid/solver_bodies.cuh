// Bodies in memory while their contacts are solved.
#pragma once

#include "core/method/rigid/solver_body.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// What no sweep changes of a body.
__device__ __forceinline__ core::SolverBody load_place(const PackedSolverBody& from) {
  const PackedVec3 inertia = from.inertia;
  const PackedVec3 moved = from.moved;
  const PackedVec3 turned = from.turned;
  core::SolverBody b;
  b.inverse_inertia = {inertia.v.x, inertia.v.y, inertia.v.z, inertia.w, moved.w, turned.w};
  b.moved = moved.v;
  b.turned = turned.v;
  return b;
}

// The rest of what contacts read.
__device__ __forceinline__ void load_velocity(const PackedSolverBody& from, core::SolverBody& b) {
  const PackedVec3 v = from.v;
  b.v = v.v;
  b.inverse_mass = v.w;
  b.angular_momentum = from.angular_momentum.v;
}

// Without the orientation, which no contact reads.
__device__ __forceinline__ core::SolverBody load_moving(const PackedSolverBody& from) {
  core::SolverBody b = load_place(from);
  load_velocity(from, b);
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
  to.angular_momentum = {b.angular_momentum, 0.0F};
}

__device__ inline void store_body(PackedSolverBody& to, const core::SolverBody& b) {
  to.v = {b.v, b.inverse_mass};
  to.angular_momentum = {b.angular_momentum, 0.0F};
  to.inertia = {{b.inverse_inertia.xx, b.inverse_inertia.yy, b.inverse_inertia.zz}, b.inverse_inertia.xy};
  to.moved = {b.moved, b.inverse_inertia.xz};
  to.turned = {b.turned, b.inverse_inertia.yz};
  to.q = b.orientation.q;
  to.q_rest = b.orientation.rest;
}

}  // namespace broadside::gpu
