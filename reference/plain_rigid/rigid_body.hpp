// One body of plain-rigid: its shape, mass and state.
#pragma once

#include <cstdint>
#include <memory>

#include "core/material.hpp"
#include "reference/plain_rigid/linear.hpp"
#include "reference/plain_rigid/polytope.hpp"

namespace broadside::reference::plain {

struct RigidBody {
  Vec half_extents;                          // m, of a box
  double radius = 0.0;                       // m, of a sphere
  std::shared_ptr<const Polytope> polytope;  // a box or a convex mesh, in mesh coordinates; null for a sphere
  double reach = 0.0;                        // m; of the farthest point from the center of mass
  core::Material material;

  double inverse_mass = 0.0;  // 1/kg; 0 = static
  Vec center_of_mass;         // m, in mesh coordinates
  Mat inertia;                // kg m^2, about the center of mass, in mesh axes
  Mat inverse_inertia;        // zero for a static body
  double slenderness = 1.0;   // root of the largest over the least principal moment

  Vec x;  // center of mass, m
  Quaternion q;
  Vec v;  // m/s
  // World frame, kg m^2/s. It is the state, and not the angular velocity, so that it is constant while nothing acts.
  Vec angular_momentum;
  // The sums of the scene's wrenches, constant in the world and in the body's axes.
  Vec force_world;   // N
  Vec force_body;    // N
  Vec torque_world;  // N m
  Vec torque_body;   // N m
  Vec static_spin;   // rad/s: the scene's value for a static body, which never turns

  [[nodiscard]] bool is_sphere() const { return polytope == nullptr; }
  [[nodiscard]] bool is_static() const { return !(inverse_mass > 0.0); }
  [[nodiscard]] Mat rotation() const { return matrix(q); }
  // Where the origin of the mesh's vertices is.
  [[nodiscard]] Vec origin() const { return x - rotation() * center_of_mass; }
  [[nodiscard]] Vec world_spin(Vec momentum, Quaternion orientation) const {
    const Mat r = matrix(orientation);
    return r * (inverse_inertia * (transposed(r) * momentum));
  }
  [[nodiscard]] Vec force() const { return force_world + rotation() * force_body; }
  [[nodiscard]] Vec torque() const { return torque_world + rotation() * torque_body; }
  [[nodiscard]] Vec angular_velocity() const { return is_static() ? static_spin : world_spin(angular_momentum, q); }
};

inline Vec velocity_at(const RigidBody& b, Vec point) {
  return b.is_static() ? Vec{} : b.v + cross(b.angular_velocity(), point - b.x);
}

}  // namespace broadside::reference::plain
