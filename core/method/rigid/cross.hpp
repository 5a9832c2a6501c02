// Cross product, unit vectors and the three axes of a turned body, in float32 with the order of operations fixed.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

BROADSIDE_HD constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

BROADSIDE_HD constexpr Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}

// The vector divided by its length; x must not be so small that its square vanishes.
BROADSIDE_HD Vec3 normalized(Vec3 a) {
  return (1.0F / length(a)) * a;
}

// The unit vector across `along` (unit) that is nearest to `towards` (of any length); zero where the two are parallel
// to within rounding. Where they are nearly parallel, what is left of `towards` is mostly rounding, some of it along
// the axis, so that part is taken away once more.
BROADSIDE_HD Vec3 direction_across(Vec3 along, Vec3 towards) {
  constexpr float kRounding = 0x1p-20F;
  const Vec3 left = towards - dot(towards, along) * along;
  const Vec3 across = left - dot(left, along) * along;
  const bool is_across = dot(across, across) > kRounding * kRounding * dot(towards, towards);
  return is_across ? (1.0F / length(across)) * across : Vec3{};
}

// A body's axes in the world: the columns of its rotation.
struct TurnedAxes {
  Vec3 x{1.0F, 0.0F, 0.0F};
  Vec3 y{0.0F, 1.0F, 0.0F};
  Vec3 z{0.0F, 0.0F, 1.0F};

  BROADSIDE_HD constexpr Vec3 operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
};

BROADSIDE_HD constexpr TurnedAxes turned_axes(Quat q) {
  return {rotate(q, {1.0F, 0.0F, 0.0F}), rotate(q, {0.0F, 1.0F, 0.0F}), rotate(q, {0.0F, 0.0F, 1.0F})};
}

// From body axes to the world, and back.
BROADSIDE_HD constexpr Vec3 turned(const TurnedAxes& axes, Vec3 v) {
  return v.x * axes.x + v.y * axes.y + v.z * axes.z;
}
BROADSIDE_HD constexpr Vec3 turned_back(const TurnedAxes& axes, Vec3 v) {
  return {dot(axes.x, v), dot(axes.y, v), dot(axes.z, v)};
}

// A unit vector across the unit vector n: the coordinate axis that n is farthest from, less its component along n,
// normalized.
BROADSIDE_HD Vec3 unit_across(Vec3 n) {
  const float x = n.x < 0.0F ? -n.x : n.x;
  const float y = n.y < 0.0F ? -n.y : n.y;
  const float z = n.z < 0.0F ? -n.z : n.z;
  const Vec3 axis =
      x <= y && x <= z ? Vec3{1.0F, 0.0F, 0.0F} : (y <= z ? Vec3{0.0F, 1.0F, 0.0F} : Vec3{0.0F, 0.0F, 1.0F});
  const Vec3 t = axis - dot(axis, n) * n;
  return (1.0F / length(t)) * t;
}

}  // namespace broadside::core
