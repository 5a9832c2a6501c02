// Vectors and quaternions of doubles, as traces of engines with float64 states hold them.
#pragma once

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

struct WideVec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr bool operator==(const WideVec3&, const WideVec3&) = default;
};

// w + xi + yj + zk, world from body.
struct WideQuat {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr bool operator==(const WideQuat&, const WideQuat&) = default;
};

constexpr Vec3 narrowed(const WideVec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
constexpr Quat narrowed(const WideQuat& q) {
  return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
}

}  // namespace broadside::core
