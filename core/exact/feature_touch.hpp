// When two moving features first touch: exact in spite of rounding. The reference answer for continuous collision
// queries.
#pragma once

#include <array>
#include <string>

#include "core/continuous/moving_features.hpp"
#include "core/result.hpp"

namespace broadside::exact {

// The default width of a bracket: the smallest step between doubles below 1.
inline constexpr unsigned kTouchBits = 53;

// The first time at which the closed features have a point in common lies in [lower, upper]. These are neighboring
// multiples of 2^-bits, or equal when the time is such a multiple. Without a touch in [0, 1], touches is false.
struct TouchTime {
  bool touches = false;
  double lower = 1.0;
  double upper = 1.0;
};

// Times are in units of the step. Coordinates are scaled to integers, and the signs of integer polynomials at their
// exact roots decide whether the features touch. So the answer is exact also for parallel edges, features in one plane,
// triangles that are segments, and points that do not move. Coordinates are finite; bits is at most kTouchBits.
TouchTime first_touch(const continuous::MovingFeatures& features, unsigned bits = kTouchBits);

// A coordinate as a fraction of two integers in decimal, with any number of digits; the second is above zero.
struct RationalText {
  std::string numerator;
  std::string denominator = "1";
};
struct RationalFeatures {
  continuous::FeatureKind kind = continuous::FeatureKind::kVertexFace;
  std::array<std::array<RationalText, 3>, 8> points;  // four at the start, four at the end
};

// The nearest doubles, which an engine can be asked about.
core::Result<continuous::MovingFeatures> rounded(const RationalFeatures& features);
// The same doubles as fractions, exactly.
RationalFeatures to_rational(const continuous::MovingFeatures& features);
// An error names the point and the axis of a coordinate that is not a fraction.
core::Result<TouchTime> first_touch(const RationalFeatures& features, unsigned bits = kTouchBits);

}  // namespace broadside::exact
