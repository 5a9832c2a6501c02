// Random moving features for tests: general ones, and coordinates on a small lattice, where parallel edges, features in
// one plane, shared points and standstill are common.
#pragma once

#include <cstdint>
#include <random>

#include "core/continuous/moving_features.hpp"

namespace broadside::tests {

inline continuous::MovingFeatures general_features(std::mt19937_64& random) {
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  continuous::MovingFeatures f;
  f.kind = random() % 2 == 0 ? continuous::FeatureKind::kVertexFace : continuous::FeatureKind::kEdgeEdge;
  for (int k = 0; k < 4; ++k) {
    f.start[k] = {at(random), at(random), at(random)};
    f.end[k] = {at(random), at(random), at(random)};
  }
  return f;
}

inline continuous::MovingFeatures lattice_features(std::mt19937_64& random) {
  continuous::MovingFeatures f = general_features(random);
  const std::uint64_t side = 2 + random() % 4;
  const bool is_flat = random() % 4 == 0;
  const bool stands_still = random() % 8 == 0;
  const auto at = [&] { return static_cast<double>(random() % side); };
  for (int k = 0; k < 4; ++k) {
    f.start[k] = {at(), at(), is_flat ? 1.0 : at()};
    f.end[k] = stands_still ? f.start[k] : core::Vec3d{at(), at(), is_flat ? 1.0 : at()};
  }
  return f;
}

inline continuous::MovingFeatures some_features(std::mt19937_64& random) {
  return random() % 2 == 0 ? general_features(random) : lattice_features(random);
}

// Places at time t, in double.
inline core::Vec3d at_time(const continuous::MovingFeatures& f, int k, double t) {
  return (1.0 - t) * f.start[k] + t * f.end[k];
}

}  // namespace broadside::tests
