// Where the words of constraints are: in tiles of 32 constraints, word by word, so that the lanes of a warp load
// neighboring words.
#pragma once

#include <cstdint>

#include "core/method/rigid/manifold.hpp"

namespace broadside::gpu {

// Words of a constraint, and of each of its points.
enum ConstraintWord : std::uint32_t {
  kBodyA,
  kBodyB,
  kPointCount,
  kNormal,
  kTangent1 = kNormal + 3,
  kTangent2 = kTangent1 + 3,
  kSurface = kTangent2 + 3,
  kSlop = kSurface + 3,
  kFastestPush,
  kPoints,
};
enum PointWord : std::uint32_t {
  kArmA,
  kArmB = kArmA + 3,
  kGap = kArmB + 3,
  kNormalMass,
  kStick11,
  kStick12,
  kStick22,
  kSlideMass,
  kImpulses,  // normal, tangent 1 and 2, of the substep
  kSlides = kImpulses + 3,
  kApproach,
  kStopping,
  kTotals,                // as kImpulses
  kBefore = kTotals + 3,  // of core::PatchWay
  kWay = kBefore + 3,
  kPointWords = kWay + 3,
};
constexpr std::uint32_t kConstraintWords = kPoints + core::kManifoldPoints * kPointWords;
constexpr std::uint32_t kTile = 32;

constexpr std::uint64_t constraint_floats(std::uint64_t places) {
  return (places + kTile - 1) / kTile * kTile * kConstraintWords;
}

}  // namespace broadside::gpu
