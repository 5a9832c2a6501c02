// Converts a vector of another library into core's: any type with x(), y() and z(), such as those of Eigen.
#pragma once

#include "core/math/vec3.hpp"

namespace broadside::reference {

template <class Vector>
core::Vec3 core_vector(const Vector& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace broadside::reference
