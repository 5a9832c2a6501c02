// How a turning body moves over one substep: RIGID 8.1. Angular momentum is the state, so it stays bit for bit while no
// torque acts; the orientation follows from it by the classical Runge-Kutta method.
#pragma once

#include "core/attributes.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {

// What acts on a body in every step beside gravity: the sums of the scene's wrenches, constant in the world and
// constant in the body's axes. Forces act at the center of mass.
struct RigidWrench {
  Vec3 force_world_n;
  Vec3 force_body_n;
  Vec3 torque_world_n_m;
  Vec3 torque_body_n_m;

  friend constexpr bool operator==(const RigidWrench&, const RigidWrench&) = default;
};

// In one part of a step a body turns by at most this much, rad: the error of one part is then below (1/2)^5 / 120.
inline constexpr float kLargestTurnOfPart = 1.0F;
// The most parts of a step. A body that would need more is turned by this many parts of the largest turn, and no
// farther: no law could tell how often it went around.
inline constexpr int kMostTurnParts = 64;

// The state after gravity and wrenches have acted for dt. Wrenches in body axes act along the axes at the start. A
// static body is returned unchanged.
BROADSIDE_HD RigidState accelerated(RigidState s, const RigidMass& mass, Vec3 gravity_m_s2, const RigidWrench& wrench,
                                    float dt_s) {
  if (!(mass.inverse_mass > 0.0F)) return s;
  const Vec3 force = wrench.force_world_n + rotate(s.q, wrench.force_body_n);
  const Vec3 torque = wrench.torque_world_n_m + rotate(s.q, wrench.torque_body_n_m);
  s.v = s.v + dt_s * (gravity_m_s2 + mass.inverse_mass * force);
  s.angular_momentum = s.angular_momentum + dt_s * torque;
  return s;
}

// An upper bound of the angular speed, rad/s, that a body can reach while it turns freely. Twice its energy is w . L,
// which is constant, and |w|^2 is at most that times the largest eigenvalue of the inverse inertia, which its trace
// bounds. So the bound for a needle that tumbles is no larger than its slenderness requires.
BROADSIDE_HD float fastest_spin_rad_s(const RigidMass& mass, Quat q, Vec3 angular_momentum) {
  const float trace = (mass.inverse_inertia.xx + mass.inverse_inertia.yy) + mass.inverse_inertia.zz;
  const float twice_energy = dot(turned_inverse_inertia(mass, q, angular_momentum), angular_momentum);
  return twice_energy > 0.0F ? sqrtf(trace * twice_energy) : 0.0F;
}

BROADSIDE_HD constexpr Quat operator+(Quat a, Quat b) {
  return {a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z};
}
BROADSIDE_HD constexpr Quat operator*(float s, Quat q) {
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}
BROADSIDE_HD constexpr float dot(Quat a, Quat b) {
  return ((a.w * b.w + a.x * b.x) + a.y * b.y) + a.z * b.z;
}

// dq/dt = 1/2 w q, where w follows from the angular momentum in the orientation q.
BROADSIDE_HD constexpr Quat orientation_rate(const RigidMass& mass, Vec3 angular_momentum, Quat q) {
  const Vec3 h = 0.5F * turned_inverse_inertia(mass, q, angular_momentum);
  return {-((h.x * q.x + h.y * q.y) + h.z * q.z), (h.x * q.w + h.y * q.z) - h.z * q.y,
          (h.y * q.w + h.z * q.x) - h.x * q.z, (h.z * q.w + h.x * q.y) - h.y * q.x};
}

// An orientation and what it lost to rounding.
struct RestedQuat {
  Quat q;
  Quat rest;
};

// a + b, and in `rest` exactly what the sum rounds away (Knuth 1969, TwoSum: for any sizes of a and b).
BROADSIDE_HD constexpr float sum_with_rest(float a, float b, float& rest) {
  const float sum = a + b;
  const float b_part = sum - a;
  const float a_part = sum - b_part;
  rest = (a - a_part) + (b - b_part);
  return sum;
}

// The sum of q and dq, of length 1. The change is computed whole before it is added, and what the addition rounds away
// is kept; so the error of a step is that of the change, far below an ulp of q. An error of the length alone turns
// nothing, so 1 / sqrt(1 + e) to second order is enough; e is of the fifth order of the turn. But the error of the
// length appears fourfold in the axes of a body, and with them in normals, so it is computed in double: in float32 the
// square is rounded as coarsely as the length itself, and normals were not of length 1 to within four ulps.
BROADSIDE_HD constexpr RestedQuat moved_on_sphere(RestedQuat s, Quat dq) {
  const auto square = [](float x) { return static_cast<double>(x) * x; };
  const double squares = ((square(s.q.w) + square(s.q.x)) + square(s.q.y)) + square(s.q.z);
  const float e = static_cast<float>(squares - 1.0) + (2.0F * dot(s.q, dq) + dot(dq, dq));
  const float shrink = e * (0.375F * e - 0.5F);
  const Quat change = s.rest + (dq + shrink * (s.q + dq));
  RestedQuat moved;
  moved.q.w = sum_with_rest(s.q.w, change.w, moved.rest.w);
  moved.q.x = sum_with_rest(s.q.x, change.x, moved.rest.x);
  moved.q.y = sum_with_rest(s.q.y, change.y, moved.rest.y);
  moved.q.z = sum_with_rest(s.q.z, change.z, moved.rest.z);
  return moved;
}

BROADSIDE_HD constexpr RestedQuat turned_part(const RigidMass& mass, Vec3 angular_momentum, RestedQuat s, float dt_s) {
  const Quat q = s.q;
  Quat outer;  // the sum of the first and the last rate
  Quat inner;  // of those between
  Quat rate;
  // The loop is not unrolled: a GPU would fetch four times as much code for one run through it.
#if defined(__CUDACC__)
#pragma unroll 1
#endif
  for (int k = 0; k < 4; ++k) {
    const bool is_outer = k == 0 || k == 3;
    const Quat at = k == 0 ? q : q + (k == 3 ? dt_s : 0.5F * dt_s) * rate;
    rate = orientation_rate(mass, angular_momentum, at);
    const Quat sum = k < 2 ? rate : (is_outer ? outer : inner) + rate;
    outer = is_outer ? sum : outer;
    inner = is_outer ? inner : sum;
  }
  return moved_on_sphere(s, (dt_s / 6.0F) * (outer + 2.0F * inner));
}

// The orientation after dt while no torque acts.
BROADSIDE_HD RestedQuat turned(const RigidMass& mass, Vec3 angular_momentum, RestedQuat s, float dt_s) {
  const float most = dt_s * fastest_spin_rad_s(mass, s.q, angular_momentum) * (1.0F / kLargestTurnOfPart);
  int parts = 1;
  float part_s = dt_s;
  if (most > 1.0F) {
    const bool is_resolved = most < static_cast<float>(kMostTurnParts);
    parts = is_resolved ? static_cast<int>(most) + 1 : kMostTurnParts;
    part_s = is_resolved ? dt_s / static_cast<float>(parts) : dt_s / most;
  }
#if defined(__CUDACC__)
#pragma unroll 1
#endif
  for (int k = 0; k < parts; ++k) s = turned_part(mass, angular_momentum, s, part_s);
  return s;
}

// Moves and turns freely for dt: the position by the velocity, the orientation by the angular momentum. Both of these
// stay the same. A static body is returned unchanged.
BROADSIDE_HD RigidState advance(RigidState s, const RigidMass& mass, float dt_s) {
  if (!(mass.inverse_mass > 0.0F)) return s;
  s.x = s.x + dt_s * s.v;
  const RestedQuat orientation = turned(mass, s.angular_momentum, {s.q, s.q_rest}, dt_s);
  s.q = orientation.q;
  s.q_rest = orientation.rest;
  return s;
}

}  // namespace broadside::core
