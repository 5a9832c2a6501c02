// Bodies in memory while their contacts are solved.
#pragma once

#include "core/method/rigid/solver_body.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/rigid/versions.cuh"

namespace broadside::gpu {

// Loads what no sweep changes and contacts read: inertia, and the motion since the start of the step. Call after a
// barrier.
__device__ __forceinline__ void load_place(const PackedSolverBody& from, core::SolverBody& b) {
  const core::Vec3 along = from.inertia_along.v;
  const core::Vec3 across = from.inertia_across.v;
  b.inverse_inertia = {along.x, along.y, along.z, across.x, across.y, across.z};
  b.moved = from.moved.v;
  b.turned = from.turned.v;
}

// Call after a barrier.
__device__ __forceinline__ void load_velocity(const PackedSolverBody& from, core::SolverBody& b) {
  b.v = from.v.v;
  b.angular_momentum = from.angular_momentum.v;
}

// Loads the mass and the velocities, which is all that a step along directions needs. Call after a barrier.
__device__ __forceinline__ core::SolverBody load_moving(const RigidFrameView& f, std::uint32_t i) {
  core::SolverBody b;
  b.inverse_mass = f.inverse_mass[i];
  load_velocity(f.bodies[i], b);
  return b;
}

// Loads everything that no sweep changes. Call after a barrier, or from the thread that moves the body.
__device__ __forceinline__ core::SolverBody load_moved(const RigidFrameView& f, std::uint32_t i) {
  core::SolverBody b;
  load_place(f.bodies[i], b);
  b.orientation = {f.bodies[i].q, f.bodies[i].q_rest};
  b.inverse_mass = f.inverse_mass[i];
  return b;
}
__device__ inline void store_moved(const RigidFrameView& f, std::uint32_t i, const core::SolverBody& b,
                                   std::uint32_t version) {
  store_place(f.bodies[i], b, version);
  f.bodies[i].q = b.orientation.q;
  f.bodies[i].q_rest = b.orientation.rest;
}

// Call after a barrier.
__device__ __forceinline__ core::SolverBody load_body(const RigidFrameView& f, std::uint32_t i) {
  core::SolverBody b = load_moved(f, i);
  load_velocity(f.bodies[i], b);
  return b;
}

// Call before the step. The first versions are 0.
__device__ inline void begin_body(const RigidFrameView& f, std::uint32_t i, const core::SolverBody& b) {
  f.bodies[i].v = {b.v, 0.0F};
  f.bodies[i].angular_momentum = {b.angular_momentum, 0.0F};
  f.inverse_mass[i] = b.inverse_mass;
  store_moved(f, i, b, 0);
}

}  // namespace broadside::gpu
