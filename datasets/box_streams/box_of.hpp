// Random draws that the generators of boxes share.
#pragma once

#include <array>

#include "core/math/box.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {

using Triple = std::array<double, 3>;

inline core::Box box_of(const Triple& center, const Triple& sides) {
  core::Box box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = static_cast<float>(center[k] - 0.5 * sides[k]);
    box.max[k] = static_cast<float>(center[k] + 0.5 * sides[k]);
  }
  return box;
}

// The order of the draws is part of a set's definition: x, then y, then z.
inline Triple drawn(RandomStream& random, double low, double high) {
  Triple t;
  for (double& v : t) v = random.between(low, high);
  return t;
}

}  // namespace broadside::datasets
