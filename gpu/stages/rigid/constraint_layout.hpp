// The layout of constraints in memory: tiles of 32 constraints, in words of 16 bytes. A tile has either the first word
// of all 32, then the second word of all, and so on; or the first two words of each, then the next two. With single
// words the lanes of a warp load neighboring words, and a sweep loads only the words that it reads. But memory
// transfers 32 bytes at least, so of a lone constraint twice as much is transferred as is read. Sweeps over stirred
// bodies visit lone constraints; where the cache does not hold all constraints, words lie in pairs. The solver knows
// the layout when it is compiled (rigid/solve_kernel.cu).
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
  kApproaches,                                  // by point: x y z w
  // What every sweep changes.
  kImpulses,  // [points] normal, tangents 1 and 2, of the substep; w: slip mobility
  // [2] core::WorldPush of these impulses, as relaxation left them; w: their version.
  kGiven = kImpulses + core::kManifoldPoints,
  // By point: x y z w.
  kBefore = kGiven + 2,    // [3] of core::PatchWay
  kWays = kBefore + 3,     // [3] of core::PatchWay
  kTotals = kWays + 3,     // [3] as impulses
  kRelaxed = kTotals + 3,  // x: the budget of a bounce; w: the latest relaxation along directions that has visited it
  kPushed,                 // [3] of core::PatchImpulsesBefore; the first number is negative where nothing is taken back
  kConstraintWords = kPushed + 3,
};
constexpr std::uint32_t kTile = 32;
constexpr std::uint32_t kWordBytes = 16;

// The number of points shares 4 bytes with a body's index.
constexpr std::uint32_t kCountShift = 29;
static_assert(core::kManifoldPoints == 4, "the points of a patch are the four parts of a word");

constexpr std::uint32_t kTileWords = kTile * ((kConstraintWords + 1) / 2 * 2);

constexpr std::uint64_t constraint_words(std::uint64_t places) {
  return (places + kTile - 1) / kTile * kTileWords;
}

// From this many bodies on words lie in pairs. A step of a million cubes then takes 0.98 of its time with soft steps
// and 0.92 by default; one of 110 000 would take 1.03 and 1.01 (gpu/EXPERIMENTS.md).
constexpr std::uint32_t kLeastBodiesForPairs = 1U << 18U;

}  // namespace broadside::gpu
