// A body as the contact solvers move it within one step: RIGID 8.5.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {

// World frame. Angular momentum is the state and angular velocity follows from it, so free bodies keep it bit for bit,
// and impulses are added to it exactly as they are recorded. A body that never moves has inverse mass and inverse
// inertia 0; contacts read it and never write it.
struct SolverBody {
  using Number = float;

  Vec3 v;                      // m/s
  Vec3 angular_momentum;       // kg m^2/s
  Symmetric3 inverse_inertia;  // world axes, of the orientation at the start of the substep
  float inverse_mass = 0.0F;
  // Since the start of the step: this is added to the positions only once, so that they do not round at every substep.
  Vec3 moved;   // of the center of mass, m
  Vec3 turned;  // sum of h w, rad: the gaps of the step follow it
  RestedQuat orientation;
};

// R M R^T.
BROADSIDE_HD constexpr Symmetric3 turned_to_world(const Symmetric3& m, Quat q) {
  const TurnedAxes axes = turned_axes(q);
  // Row i of R, and of R M.
  const Vec3 rows[3] = {{axes.x.x, axes.y.x, axes.z.x}, {axes.x.y, axes.y.y, axes.z.y}, {axes.x.z, axes.y.z, axes.z.z}};
  const Vec3 products[3] = {m * rows[0], m * rows[1], m * rows[2]};
  const auto entry = [&](int i, int j) { return dot(products[i], rows[j]); };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

template <typename Body>
BROADSIDE_HD constexpr auto is_moved(const Body& body) {
  return body.inverse_mass > 0.0F;
}

template <typename Body>
BROADSIDE_HD constexpr auto angular_velocity(const Body& body) {
  return body.inverse_inertia * body.angular_momentum;
}

BROADSIDE_HD constexpr SolverBody solver_body(const RigidState& s, const RigidMass& mass) {
  SolverBody body;
  body.v = s.v;
  body.angular_momentum = s.angular_momentum;
  body.orientation = {s.q, s.q_rest};
  body.inverse_mass = mass.inverse_mass;
  if (is_moved(body)) body.inverse_inertia = turned_to_world(mass.inverse_inertia, s.q);
  return body;
}

// Applies gravity and the wrench for one substep.
BROADSIDE_HD void accelerate(SolverBody& body, Vec3 gravity_m_s2, const RigidWrench* wrench, float dt_s) {
  if (!is_moved(body)) return;
  Vec3 acceleration = gravity_m_s2;
  if (wrench != nullptr) {
    acceleration =
        acceleration + body.inverse_mass * (wrench->force_world_n + rotate(body.orientation.q, wrench->force_body_n));
    const Vec3 torque = wrench->torque_world_n_m + rotate(body.orientation.q, wrench->torque_body_n_m);
    body.angular_momentum = body.angular_momentum + dt_s * torque;
  }
  body.v = body.v + dt_s * acceleration;
}

BROADSIDE_HD void move(SolverBody& body, const RigidMass& mass, float dt_s) {
  if (!is_moved(body)) return;
  body.moved = body.moved + dt_s * body.v;
  body.turned = body.turned + dt_s * angular_velocity(body);
  body.orientation = turned(mass, body.angular_momentum, body.orientation, dt_s);
  body.inverse_inertia = turned_to_world(mass.inverse_inertia, body.orientation.q);
}

BROADSIDE_HD constexpr RigidState state_after(const SolverBody& body, const RigidState& before) {
  if (!is_moved(body)) return before;
  return {before.x + body.moved, body.orientation.q, body.v, body.angular_momentum, body.orientation.rest};
}

}  // namespace broadside::core
