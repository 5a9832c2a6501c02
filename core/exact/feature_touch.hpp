// When two moving features first touch: exact, whatever the rounding. The arbiter of continuous collision queries.
#pragma once

#include <array>
#include <string>

#include "core/continuous/moving_features.hpp"
#include "core/result.hpp"

namespace broadside::exact {

// The bracket is as wide as the least step between doubles below 1.
inline constexpr unsigned kTouchBits = 53;

// The first time at which the closed features have a point in common lies in [lower, upper]: between two multiples of
// 2^-bits, or on one, and then both are that one. No touch in [0, 1]: touches is false.
struct TouchTime {
  bool touches = false;
  double lower = 1.0;
  double upper = 1.0;
};

// In units of the step. Whether they touch is decided by the signs of integer polynomials at their exact roots, after
// the coordinates were scaled to integers; so it holds for parallel edges, features in one plane, triangles that are
// segments, and points that do not move. Coordinates are finite; bits is at most kTouchBits.
TouchTime first_touch(const continuous::MovingFeatures& features, unsigned bits = kTouchBits);

// A coordinate as two integers in decimal digits of any number, the second above zero.
struct RationalText {
  std::string numerator;
  std::string denominator = "1";
};
struct RationalFeatures {
  continuous::FeatureKind kind = continuous::FeatureKind::kVertexFace;
  std::array<std::array<RationalText, 3>, 8> points;  // four at the start, four at the end
};

// The nearest doubles: what an engine can be asked about.
core::Result<continuous::MovingFeatures> rounded(const RationalFeatures& features);
// Doubles as they are.
RationalFeatures to_rational(const continuous::MovingFeatures& features);
// Errors name the point and the axis of a coordinate that is no fraction.
core::Result<TouchTime> first_touch(const RationalFeatures& features, unsigned bits = kTouchBits);

}  // namespace broadside::exact
