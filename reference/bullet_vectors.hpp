// Bullet's vectors and transforms from ours, and back. Bullet is built with float32 here, so both ways keep every bit.
#pragma once

#include <LinearMath/btTransform.h>

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"

namespace broadside::reference {

static_assert(sizeof(btScalar) == sizeof(float),
              "the conversions keep every bit only where Bullet's scalar is a float");

inline btVector3 bullet(core::Vec3 v) {
  return {v.x, v.y, v.z};
}

inline core::Vec3 to_core(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

inline btTransform bullet_transform(core::Vec3 position, core::Quat orientation) {
  return btTransform(btQuaternion(orientation.x, orientation.y, orientation.z, orientation.w), bullet(position));
}

inline core::Quat to_core(const btQuaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace broadside::reference
