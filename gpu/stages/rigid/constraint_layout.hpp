// The layout of constraints in memory: tiles of 32 constraints, which have word after word of 16 bytes for all 32. So
// the lanes of a warp load neighboring words, and a sweep loads only the words that it reads.
#pragma once

#include <cstdint>

#include "core/method/rigid/manifold.hpp"

namespace broadside::gpu {

enum ConstraintWord : std::uint32_t {
  // What no sweep changes.
  kPatchBodies,                                 // body A and the number of points, body B, slop, fastest push
  kNormal,                                      // w: static friction
  kTangent,                                     // the first tangent; w: kinetic friction
  kAcross,                                      // from A's center of mass to B's; w: restitution
  kLevers,                                      // [points] of core::PatchPoint; w: gap
  kMasses = kLevers + core::kManifoldPoints,    // [points] normal mass, stick masses 11, 12, 22
  kMobility = kMasses + core::kManifoldPoints,  // [6] core::TwistMobility, then from A's center of mass to the patch's
  kOrder = kMobility + 6,                       // of A and of B: PlaceInOrder; then their inverse masses
  // What every sweep changes.
  kImpulses = kOrder + 1,  // [points] normal, tangents 1 and 2, of the substep; w: slip mobility
  // [2] core::WorldPush of these impulses, as relaxation left them; w: their version.
  kGiven = kImpulses + core::kManifoldPoints,
  // By point: x y z w.
  kApproaches = kGiven + 2,
  kRelaxed,               // x: the budget of a bounce; w: the latest relaxation along directions that has visited it
  kTotals,                // [3] as impulses
  kBefore = kTotals + 3,  // [3] of core::PatchWay
  kWays = kBefore + 3,    // [3] of core::PatchWay
  kPushed = kWays + 3,    // [3] of core::PatchImpulsesBefore; the first number is negative where nothing is taken back
  kConstraintWords = kPushed + 3,
};
constexpr std::uint32_t kTile = 32;
constexpr std::uint32_t kWordBytes = 16;

// The number of points shares 4 bytes with a body's index.
constexpr std::uint32_t kCountShift = 29;
static_assert(core::kManifoldPoints == 4, "the points of a patch are the four parts of a word");

constexpr std::uint64_t constraint_words(std::uint64_t places) {
  return (places + kTile - 1) / kTile * kTile * kConstraintWords;
}

}  // namespace broadside::gpu
