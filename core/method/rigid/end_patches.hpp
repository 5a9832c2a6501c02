// Patches that are found only at the end of a step, where a body that turns comes down on another one.
//
// Contacts are detected at the start of a step. A corner that turns into the other body within the step is on no patch
// there. Before, a bunny that lands rolled into the floor by 7 cm, and small cubes that spin under large ones ended a
// tenth of their side deep. So contacts of bodies that turn are detected a second time, where the bodies end if they
// touch nothing. An overlap that is found there is moved back, with each body, to the start of the step.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/moved_back.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/quick_boxes.hpp"
#include "core/method/rigid/quick_hulls.hpp"
#include "core/method/rigid/quick_rounds.hpp"

namespace broadside::core {

namespace end_detail {

// An arm from the center of mass at the start of the step, as it is at the end.
BROADSIDE_HD Vec3 at_end(const ContactPath& path, Vec3 arm) {
  return turned(turned_axes(path.end.q), turned_back(turned_axes(path.start.q), arm));
}

// The gap that a point of the start has at the end.
BROADSIDE_HD float gap_at_end(const Manifold& m, const ManifoldPoint& p, const ContactPath& a, const ContactPath& b) {
  const Vec3 arm_b = p.point + (a.start.x - b.start.x);
  const Vec3 moved_a = (a.end.x - a.start.x) + (at_end(a, p.point) - p.point);
  const Vec3 moved_b = (b.end.x - b.start.x) + (at_end(b, arm_b) - arm_b);
  return p.gap_m + dot(m.normal, moved_a - moved_b);
}

// Whether a patch of the start has a point that is near this one and comes as deep.
BROADSIDE_HD bool is_foreseen(const ManifoldPoint& p, float end_gap_m, const Manifold* found, int count,
                              const ContactPath& a, const ContactPath& b, float near_m, float slack_m) {
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < found[k].count; ++i) {
      const ManifoldPoint& q = found[k].points[i];
      const Vec3 between = q.point - p.point;
      if (dot(between, between) <= near_m * near_m && gap_at_end(found[k], q, a, b) <= end_gap_m + slack_m) return true;
    }
  return false;
}

}  // namespace end_detail

// Adds patches to those of the start, found[0 .. count), and returns how many there are then, kPatchesOfPair at most;
// kLeft if the lane leaves the pair. swing_m: how far turning moves points of both bodies. known: what surely_passes
// found, or null.
template <typename Lanes = OneLane>
BROADSIDE_HD_CALLED int add_end_patches(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                                        const ContactPath& b, float swing_m, Manifold* found, int count,
                                        const KnownGaps* known = nullptr) {
  // In sizes of the smaller body. Points nearer to each other than kNear count as one. It is not known from which side
  // a point deeper than kDeepest came, so such a point is left out.
  constexpr float kNear = 0x1p-3F;
  constexpr float kDeepest = 0x1p-2F;
  const bool is_plane = shape_b.kind == ContactKind::kHalfSpace;
  const float size_m = is_plane ? shape_a.size_m : fminf(shape_a.size_m, shape_b.size_m);
  const float unseen = unseen_m(shape_a, shape_b);
  if (count == 0 || !(swing_m > unseen)) return count;
  if (are_boxes(shape_a, shape_b) && gap_of_boxes(shape_a, a.end, shape_b, b.end, found[0].normal) > -unseen)
    return count;
  if (has_round_answers(shape_a, shape_b) &&
      surely_apart(round_bounds(shape_a, a.end, shape_b, b.end, -unseen, found[0].normal), -unseen))
    return count;
  if constexpr (Lanes::kKnowsLongShapes)
    if (known != nullptr || has_quick_answers(shape_a, shape_b)) {
      const HullBounds bounds =
          known != nullptr ? known->deep_end : hull_bounds(shape_a, a.end, shape_b, b.end, -unseen, found[0].normal);
      if (surely_apart(bounds, -unseen)) return count;
    }
  float least_m = least_gap_m(found[0]);
  for (int k = 1; k < count; ++k) least_m = fminf(least_m, least_gap_m(found[k]));
  least_m = fminf(least_m, 0.0F);
  Manifold end[kPatchesOfPair];
  const int ends = make_manifolds<Lanes>(shape_a, a.end, shape_b, b.end, -unseen, end);
  if (ends == kLeft) return kLeft;
  const int at_start = count;
  for (int k = 0; k < ends && count < kPatchesOfPair; ++k) {
    const Manifold& m = end[k];
    if (!(dot(m.normal, found[0].normal) > 0.0F) || !(-least_gap_m(m) < kDeepest * size_m)) continue;
    Manifold& out = found[count];
    out.normal = m.normal;
    out.count = 0;
    for (int i = 0; i < m.count; ++i) {
      const ManifoldPoint& p = m.points[i];
      const MovedBack at = moved_back(m.normal, p, a, b);
      // At the start the bodies may overlap more along this normal than they do: the gap is bounded below. A plane is
      // unbounded, so the point is placed where the body is.
      const Vec3 middle = is_plane ? at.on_a - (0.5F * at.gap_m) * m.normal : 0.5F * (at.on_a + at.on_b);
      const ManifoldPoint back{middle, fmaxf(at.gap_m, least_m), p.feature};
      if (!end_detail::is_foreseen(back, p.gap_m, found, at_start, a, b, kNear * size_m, unseen))
        out.points[out.count++] = back;
    }
    if (out.count > 0) ++count;
  }
  return count;
}

}  // namespace broadside::core
