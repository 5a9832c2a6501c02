// The state of a turning body, and what its motion needs of its mass. RIGID 8.1.
//
// Host and device give the same bits, so formulas in this folder use + - * / and sqrt alone: sine, cosine and the like
// are rounded differently by every library.
#pragma once

#include "core/attributes.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

// World frame.
struct RigidState {
  Vec3 x;                 // center of mass, m
  Quat q;                 // world from body (the mesh's axes)
  Vec3 v;                 // of the center of mass, m/s
  Vec3 angular_momentum;  // about the center of mass, kg m^2/s: constant, bit for bit, while no torque acts
  // What q lost to rounding so far; it is added at the next turn. Half an ulp a step turns a tumbling free brick by 5
  // degrees in 10 s at 1 ms.
  Quat q_rest{0.0F, 0.0F, 0.0F, 0.0F};

  friend constexpr bool operator==(const RigidState&, const RigidState&) = default;
};

// A symmetric matrix.
struct Symmetric3 {
  float xx = 0.0F;
  float yy = 0.0F;
  float zz = 0.0F;
  float xy = 0.0F;
  float xz = 0.0F;
  float yz = 0.0F;

  friend constexpr bool operator==(const Symmetric3&, const Symmetric3&) = default;
};

// Products are added left to right, as in dot.
BROADSIDE_HD constexpr Vec3 operator*(const Symmetric3& m, Vec3 v) {
  return {(m.xx * v.x + m.xy * v.y) + m.xz * v.z, (m.xy * v.x + m.yy * v.y) + m.yz * v.z,
          (m.xz * v.x + m.yz * v.y) + m.zz * v.z};
}

struct RigidMass {
  float inverse_mass = 0.0F;   // 1/kg; 0 = static
  Symmetric3 inverse_inertia;  // 1/(kg m^2), about the center of mass, in body axes; zero for a static body
  Vec3 center_of_mass;         // m, in mesh coordinates
};

// v in body axes: turned by the inverse of q.
BROADSIDE_HD constexpr Vec3 rotate_back(Quat q, Vec3 v) {
  return rotate(Quat{q.w, -q.x, -q.y, -q.z}, v);
}

// The inverse inertia in world axes, times a vector of the world: the angular velocity (rad/s) of an angular momentum.
BROADSIDE_HD constexpr Vec3 turned_inverse_inertia(const RigidMass& mass, Quat q, Vec3 v) {
  return rotate(q, mass.inverse_inertia * rotate_back(q, v));
}

BROADSIDE_HD constexpr Vec3 angular_velocity(const RigidMass& mass, const RigidState& s) {
  return turned_inverse_inertia(mass, s.q, s.angular_momentum);
}

// The position of the mesh's origin, from which its vertices are measured.
BROADSIDE_HD constexpr Vec3 mesh_origin(const RigidMass& mass, const RigidState& s) {
  return s.x - rotate(s.q, mass.center_of_mass);
}

}  // namespace broadside::core
