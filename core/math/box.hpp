// An axis-aligned bounding box, closed on every side.
#pragma once

#include <limits>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

struct Box {
  Vec3 min;
  Vec3 max;

  friend constexpr bool operator==(const Box&, const Box&) = default;
};

// The empty box: growing it by a point gives that point's box, and it overlaps nothing.
BROADSIDE_HD constexpr Box empty_box() {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  return {{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}};
}

BROADSIDE_HD constexpr bool is_empty(const Box& b) {
  return !(b.min.x <= b.max.x);
}

BROADSIDE_HD constexpr Box grown(const Box& b, Vec3 p) {
  return {{p.x < b.min.x ? p.x : b.min.x, p.y < b.min.y ? p.y : b.min.y, p.z < b.min.z ? p.z : b.min.z},
          {p.x > b.max.x ? p.x : b.max.x, p.y > b.max.y ? p.y : b.max.y, p.z > b.max.z ? p.z : b.max.z}};
}

// Rounding is monotone, so the rounded translation of a tight box is the tight box of the rounded translated points:
// a body that only translates never needs its vertices visited to refresh its box, P(5).
BROADSIDE_HD constexpr Box translated(const Box& b, Vec3 x) {
  return {b.min + x, b.max + x};
}

// P(6): closed intervals overlap on all three axes; touching counts.
BROADSIDE_HD constexpr bool overlaps(const Box& a, const Box& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
         b.min.z <= a.max.z;
}

BROADSIDE_HD constexpr Vec3 center(const Box& b) {
  return {0.5F * (b.min.x + b.max.x), 0.5F * (b.min.y + b.max.y), 0.5F * (b.min.z + b.max.z)};
}

}  // namespace broadside::core
