// A vector of scenes and traces (float) as a point of the exact arbiters, which compute in double.
#pragma once

#include "core/exact/triangle_distance.hpp"
#include "core/math/vec3.hpp"

namespace broadside::reference {

inline core::Vec3 to_core(exact::Point p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

}  // namespace broadside::reference
