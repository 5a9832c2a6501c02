// A unit quaternion w + xi + yj + zk: the orientation of a body, world from body.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

struct Quat {
  float w = 1.0F;
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

// v rotated by the unit quaternion q. The identity returns v unchanged, bit for bit.
BROADSIDE_HD constexpr Vec3 rotate(Quat q, Vec3 v) {
  const Vec3 t{2.0F * (q.y * v.z - q.z * v.y), 2.0F * (q.z * v.x - q.x * v.z), 2.0F * (q.x * v.y - q.y * v.x)};
  return {v.x + q.w * t.x + (q.y * t.z - q.z * t.y), v.y + q.w * t.y + (q.z * t.x - q.x * t.z),
          v.z + q.w * t.z + (q.x * t.y - q.y * t.x)};
}

}  // namespace broadside::core
