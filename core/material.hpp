// Friction and restitution of a surface, and the rule that combines two of them.
#pragma once

#include <cmath>

#include "core/attributes.hpp"

namespace broadside::core {

struct Material {
  float mu_static = 0.6F;    // P-Table 1
  float mu_kinetic = 0.5F;   // P-Table 1
  float restitution = 0.3F;  // not published; ours

  friend constexpr bool operator==(const Material&, const Material&) = default;
};

// Geometric mean of the frictions, the larger restitution. Equal materials combine to themselves exactly: IEEE sqrt of
// a rounded square returns the operand.
BROADSIDE_HD Material combine(const Material& a, const Material& b) {
  return {sqrtf(a.mu_static * b.mu_static), sqrtf(a.mu_kinetic * b.mu_kinetic),
          a.restitution > b.restitution ? a.restitution : b.restitution};
}

}  // namespace broadside::core
