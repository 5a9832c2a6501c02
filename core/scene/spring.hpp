// A damped spring between one body and a point of the world: the m x'' + c x' + k x = 0 of METHOD section 1.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"

namespace broadside::core {

// Exerts the force -stiffness (x - anchor) - damping v. A body may have several springs: their forces add.
struct Spring {
  std::uint32_t body = 0;
  Vec3 anchor;                 // the point to which it pulls, m
  float stiffness_n_m = 0.0F;  // k >= 0
  float damping_n_s_m = 0.0F;  // c >= 0

  friend constexpr bool operator==(const Spring&, const Spring&) = default;
};

}  // namespace broadside::core
