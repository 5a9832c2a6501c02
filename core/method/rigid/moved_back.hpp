// Points of contact that bodies have at the end of a step, moved back with each body to its start.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/manifold.hpp"

namespace broadside::core {

// An arm from the center of mass at the end of the step, as it was at the start.
BROADSIDE_HD Vec3 arm_at_start(const ContactPath& path, Vec3 arm) {
  return turned(turned_axes(path.start.q), turned_back(turned_axes(path.end.q), arm));
}

// The point of each body's surface that is a point of a manifold at the end, as it was at the start, relative to A's
// center of mass there; and the gap between both along the normal at the end.
struct MovedBack {
  Vec3 on_a;
  Vec3 on_b;
  float gap_m = 0.0F;
};

BROADSIDE_HD MovedBack moved_back(Vec3 normal, const ManifoldPoint& p, const ContactPath& a, const ContactPath& b) {
  const Vec3 half = (0.5F * p.gap_m) * normal;
  MovedBack back;
  back.on_a = arm_at_start(a, p.point + half);
  back.on_b = arm_at_start(b, (p.point - half) + (a.end.x - b.end.x)) + (b.start.x - a.start.x);
  back.gap_m = dot(normal, back.on_a - back.on_b);
  return back;
}

}  // namespace broadside::core
