// One point of contact in one step, as reported by engines that solve all contacts together: totals, not applications.
#pragma once

#include <cstdint>

#include "core/contact.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

// A is a body, B another body or a face of the domain (kFirstFace + k). World frame.
struct ContactPoint {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  Vec3 point;                 // m
  Vec3 normal;                // unit, from B to A
  float gap_m = 0.0F;         // at detection, along the normal; negative is penetration
  Vec3 impulse;               // N s on A, over the whole step: normal part and friction together
  std::uint32_t feature = 0;  // the engine's own id of this point, the same while it lasts; 0 = none
};

static_assert(sizeof(ContactPoint) == 13 * sizeof(float), "a new property of a point needs its column");

}  // namespace broadside::core
