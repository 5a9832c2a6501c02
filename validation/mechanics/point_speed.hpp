// How fast points of bodies move, and how uncertain that is: for laws about points of contact.
#pragma once

#include "core/contact_point.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

enum class Moment { kStart, kEnd };

// Of the body's point there, m/s; zero for faces and static bodies. The arm is that of the step's start, to which
// points belong.
inline Vec3d speed_at(const Motion& m, std::uint32_t body, Vec3d point, Moment moment) {
  if (core::is_face(body) || !m.facts[body].is_dynamic) return {};
  const BodyStep& b = m.bodies[body];
  const BodyState& s = moment == Moment::kStart ? b.before : b.after;
  return s.v + cross(s.w, point - b.before.x);
}

// What an impulse does to a body: changes of velocity and, about its center of mass, of angular velocity. j: N s, at
// the point, in the orientation of the step's start.
struct Change {
  Vec3d dv;  // m/s
  Vec3d dw;  // rad/s
};

inline Change change_by(const Motion& m, std::uint32_t body, Vec3d point, Vec3d j) {
  if (core::is_face(body) || !m.facts[body].is_dynamic) return {};
  const BodyFacts& f = m.facts[body];
  const BodyState& s = m.bodies[body].before;
  const bool turns = f.has_inertia && m.turns;
  const Vec3d moment = turns ? transposed_times(s.r, cross(point - s.x, j)) : Vec3d{};
  return {(1.0 / f.mass_kg) * j, turns ? s.r * (f.inverse_inertia * moment) : Vec3d{}};
}

// By how much the point's speed at the end differs, m/s, when the spin is computed from the body's angular momentum in
// the orientation of the start instead of that of the end: engines solve contacts in the one and record the other.
inline double change_by_turning(const Motion& m, std::uint32_t body, Vec3d point) {
  if (core::is_face(body) || !m.facts[body].has_inertia || !m.turns) return 0.0;
  const BodyState& s0 = m.bodies[body].before;
  const BodyState& s1 = m.bodies[body].after;
  const Vec3d w = s0.r * (m.facts[body].inverse_inertia * transposed_times(s0.r, s1.angular_momentum));
  return length(cross(s1.w - w, point - s0.x));
}

}  // namespace broadside::validation
