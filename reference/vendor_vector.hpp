// A vector of somebody else's library as one of core's: one with x(), y() and z(), as those of Eigen are.
#pragma once

#include "core/math/vec3.hpp"

namespace broadside::reference {

template <class Vector>
core::Vec3 core_vector(const Vector& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace broadside::reference
