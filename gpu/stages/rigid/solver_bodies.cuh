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

__device__ __forceinline__ void load_velocity(const PackedSolverBody& from, core::SolverBody& b) {
  b.v = from.v.v;
  b.angular_momentum = from.angular_momentum.v;
}

// Without the orientation, which no contact reads.
__device__ __forceinline__ core::SolverBody load_moving(const PackedSolverBody& from) {
  core::SolverBody b = load_place(from);
  load_velocity(from, b);
  b.inverse_mass = from.mass.v.x;
  return b;
}

__device__ inline core::SolverBody load_body(const PackedSolverBody& from) {
  core::SolverBody b = load_moving(from);
  b.orientation = {from.q, from.q_rest};
  return b;
}

// Three floats with a version, in one access that is never torn.
__device__ __forceinline__ void store_versioned(PackedVec3& to, core::Vec3 v, std::uint32_t version) {
  GridWords::store_whole(reinterpret_cast<uint4*>(&to),
                         {__float_as_uint(v.x), __float_as_uint(v.y), __float_as_uint(v.z), version});
}

// What a contact changes. version: of the velocities.
__device__ __forceinline__ void store_velocity(PackedSolverBody& to, const core::SolverBody& b, std::uint32_t version) {
  if (!core::is_moved(b)) return;
  store_versioned(to.v, b.v, version);
  store_versioned(to.angular_momentum, b.angular_momentum, version);
}

__device__ inline void store_body(PackedSolverBody& to, const core::SolverBody& b, std::uint32_t version) {
  to.v = {b.v, __uint_as_float(version)};
  to.angular_momentum = {b.angular_momentum, __uint_as_float(version)};
  to.mass = {{b.inverse_mass, 0.0F, 0.0F}, 0.0F};
  to.inertia = {{b.inverse_inertia.xx, b.inverse_inertia.yy, b.inverse_inertia.zz}, b.inverse_inertia.xy};
  to.moved = {b.moved, b.inverse_inertia.xz};
  to.turned = {b.turned, b.inverse_inertia.yz};
  to.q = b.orientation.q;
  to.q_rest = b.orientation.rest;
}

}  // namespace broadside::gpu
