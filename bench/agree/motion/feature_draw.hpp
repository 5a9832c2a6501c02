// Moving vertices, triangles and edges for the motion study: a general family, and families in which rounding decides.
#pragma once

#include <cstdint>

#include "bench/agree/motion/motion_test.hpp"
#include "core/exact/feature_touch.hpp"

namespace broadside::bench {

// The same kind, seed and index always give the same query. Coordinates are doubles, except in the family "fractions".
struct DrawnFeatures {
  std::uint8_t family = 0;
  exact::RationalFeatures query;
};
DrawnFeatures draw_features(MotionKind kind, std::uint64_t seed, std::uint64_t index);

// Makes a test with the arbiter's answers for the fractions and for their nearest doubles. Errors name the coordinate.
core::Result<MotionTest> to_test(const exact::RationalFeatures& query, std::uint8_t family);

}  // namespace broadside::bench
