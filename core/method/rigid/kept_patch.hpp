// Patches of finely cut hulls that are carried along with their bodies, and not made anew, while the two bodies hardly
// move against each other. Making a patch takes some 70,000 operations; carrying it only turns and shifts its points.
// Of the patches of 1000 bunnies that rest five of six are carried (soft steps, frames 600 to 900).
//
// The motion of the bodies is measured since the patch was made, not since the step before, so errors do not add up: a
// gap is off by no more than kept_within_m. Without gravity that is 0, and all patches are made anew.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/quick_hulls.hpp"

namespace broadside::core {

// B as seen from A.
struct PoseOfOther {
  Vec3 x;  // B's center of mass, A's axes, m
  Quat q;  // A's axes from B's
};

BROADSIDE_HD constexpr Quat turn_between(Quat a, Quat b) {
  return {((a.w * b.w + a.x * b.x) + a.y * b.y) + a.z * b.z, ((a.w * b.x - a.x * b.w) - a.y * b.z) + a.z * b.y,
          ((a.w * b.y + a.x * b.z) - a.y * b.w) - a.z * b.x, ((a.w * b.z - a.x * b.y) + a.y * b.x) - a.z * b.w};
}

BROADSIDE_HD constexpr PoseOfOther pose_of_other(const ContactPose& a, const ContactPose& b) {
  return {turned_back(turned_axes(a.q), b.x - a.x), turn_between(a.q, b.q)};
}

// An upper bound, m, of how far any point of B, which reaches outer_b_m from its center of mass, has moved against A.
BROADSIDE_HD float moved_between(const PoseOfOther& before, const PoseOfOther& now, float outer_b_m) {
  const Quat turn = turn_between(before.q, now.q);
  const float half_chord = length(Vec3{turn.x, turn.y, turn.z});  // the sine of half of the turn
  return length(now.x - before.x) + 2.0F * half_chord * outer_b_m;
}

struct KeptPoint {
  Vec3 on_a;  // of A's surface, from its center of mass, A's axes, m
  Vec3 on_b;  // of B's surface, from its center of mass, B's axes, m
  std::uint32_t feature = 0;
};

struct alignas(16) KeptPatch {
  PoseOfOther made_at;
  Vec3 normal;              // unit, from B to A, A's axes
  std::uint32_t count = 0;  // of points; 0: nothing is kept
  KeptPoint points[kManifoldPoints];
};

BROADSIDE_HD KeptPatch kept_patch(const Manifold& m, const ContactPose& a, const ContactPose& b) {
  const TurnedAxes axes_a = turned_axes(a.q);
  const TurnedAxes axes_b = turned_axes(b.q);
  KeptPatch kept;
  kept.made_at = pose_of_other(a, b);
  kept.normal = turned_back(axes_a, m.normal);
  kept.count = static_cast<std::uint32_t>(m.count);
  for (int k = 0; k < m.count; ++k) {
    const ManifoldPoint& p = m.points[k];
    const Vec3 half = (0.5F * p.gap_m) * m.normal;
    kept.points[k] = {turned_back(axes_a, p.point + half), turned_back(axes_b, (p.point - half) + (a.x - b.x)),
                      p.feature};
  }
  return kept;
}

// Moves the patch to where its bodies are now.
BROADSIDE_HD void carry(const KeptPatch& kept, const ContactPose& a, const ContactPose& b, Manifold& out) {
  const TurnedAxes axes_a = turned_axes(a.q);
  const TurnedAxes axes_b = turned_axes(b.q);
  out.normal = normalized(turned(axes_a, kept.normal));
  out.count = static_cast<int>(kept.count);
  for (int k = 0; k < out.count; ++k) {
    const KeptPoint& p = kept.points[k];
    const Vec3 on_a = turned(axes_a, p.on_a);
    const Vec3 on_b = turned(axes_b, p.on_b) + (b.x - a.x);
    out.points[k] = {0.5F * (on_a + on_b), dot(out.normal, on_a - on_b), p.feature};
  }
}

// How far two bodies may have moved against each other since their patch was made: a share of falls_m, which is how far
// gravity moves both in a step, so that it scales with the step. For bodies that are small against that, it is a share
// of their size.
BROADSIDE_HD float kept_within_m(const ContactShape& a, const ContactShape& b, float falls_m) {
  constexpr float kShareOfFalls = 0x1p-3F;
  constexpr float kShareOfSize = 0x1p-10F;
  return fminf(kShareOfFalls * falls_m, kShareOfSize * fminf(a.size_m, b.size_m));
}

// Whether a pair is one whose patches may be carried in this step: both are finely cut hulls, neither is followed on
// its way (sweep.hpp), and both are slow. Faster ones may meet at other points, or pass by each other.
BROADSIDE_HD bool may_be_carried(const ContactShape& a, const ContactShape& b, const PairAhead& ahead) {
  constexpr float kMostReach = 1.5F;  // of what gravity alone gives
  return ahead.may_pass && has_quick_answers(a, b) && ahead.reach_m <= kMostReach * ahead.near.falls_m &&
         ahead.swing_m <= unseen_m(a, b);
}

// Carries a patch to where its bodies are, if it may be used in place of a new one. outer_b_m: no point of B is farther
// from B's center of mass.
BROADSIDE_HD bool carried(const KeptPatch& kept, const ContactShape& shape_a, const ContactPose& a,
                          const ContactShape& shape_b, const ContactPose& b, float outer_b_m, float falls_m,
                          Manifold& out) {
  if (kept.count == 0) return false;
  if (!(moved_between(kept.made_at, pose_of_other(a, b), outer_b_m) < kept_within_m(shape_a, shape_b, falls_m)))
    return false;
  carry(kept, a, b, out);
  // A patch with a larger gap than the bodies fall would have to be tested for whether they pass by each other.
  return least_gap_m(out) <= falls_m;
}

}  // namespace broadside::core
