// Patches of bodies that pass by each other. Contacts are looked for in every direction, as far ahead as bodies can
// move. But a body that flies past a corner must not be stopped by the plane through that corner.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/moved_back.hpp"
#include "core/method/rigid/quick_boxes.hpp"
#include "core/method/rigid/quick_hulls.hpp"
#include "core/method/rigid/quick_rounds.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {

// Where a body is after the step if it touches nothing.
BROADSIDE_HD ContactPose free_end(const RigidState& s, const RigidMass& mass, Vec3 gravity_m_s2,
                                  const RigidWrench& wrench, float dt_s) {
  const RigidState end = advance(accelerated(s, mass, gravity_m_s2, wrench, dt_s), mass, dt_s);
  return {end.x, end.q};
}

BROADSIDE_HD float least_gap_m(const Manifold& m) {
  float least = m.points[0].gap_m;
  for (int k = 1; k < m.count; ++k) least = fminf(least, m.points[k].gap_m);
  return least;
}

// Whether two bodies that are apart at the start are apart at these poses too, on the same side. The answer is kNo if
// one went through the other, or if they are too far apart to tell, and kUnknown if the lane leaves the pair.
template <typename Lanes>
BROADSIDE_HD QuickAnswer is_still_apart(const Manifold& start, const ContactShape& shape_a, const ContactPose& a,
                                        const ContactShape& shape_b, const ContactPose& b, float reach_m) {
  if (has_round_answers(shape_a, shape_b)) {
    const QuickAnswer quick =
        quickly_still_apart(start.normal, round_bounds(shape_a, a, shape_b, b, reach_m, start.normal), reach_m);
    if (quick != QuickAnswer::kUnknown) return quick;
  }
  if constexpr (Lanes::kKnowsLongShapes)
    if (has_quick_answers(shape_a, shape_b)) {
      const QuickAnswer quick =
          quickly_still_apart(start.normal, hull_bounds(shape_a, a, shape_b, b, reach_m, start.normal), reach_m);
      if (quick != QuickAnswer::kUnknown) return quick;
    }
  Manifold end[kPatchesOfPair];
  const int count = make_manifolds<Lanes>(shape_a, a, shape_b, b, reach_m, end);
  if (count == kLeft) return QuickAnswer::kUnknown;
  for (int k = 0; k < count; ++k)
    if (!(least_gap_m(end[k]) > 0.0F && dot(start.normal, end[k].normal) > 0.0F)) return QuickAnswer::kNo;
  return count > 0 ? QuickAnswer::kYes : QuickAnswer::kNo;
}

// Whether a patch leads to no contact in this step, whether both bodies move freely or something holds one of them
// where it is. A patch nearer than near_m is kept in any case, because a patch so near may bear a resting body.
// kUnknown if the lane leaves the pair.
template <typename Lanes>
BROADSIDE_HD QuickAnswer whether_passes_by(const Manifold& start, const ContactShape& shape_a, const ContactPath& a,
                                           const ContactShape& shape_b, const ContactPath& b, float reach_m,
                                           float near_m) {
  if (!(least_gap_m(start) > near_m)) return QuickAnswer::kNo;
  if (are_boxes(shape_a, shape_b) && parts_ends(start.normal, shape_a, a, shape_b, b)) return QuickAnswer::kYes;
  const float seen_m = seen_reach_m(reach_m);
  const auto are_apart = [&](const ContactPose& at_a, const ContactPose& at_b) {
    return is_still_apart<Lanes>(start, shape_a, at_a, shape_b, at_b, seen_m);
  };
  QuickAnswer answer = are_apart(a.end, b.end);
  if (answer == QuickAnswer::kYes) answer = are_apart(a.end, b.start);
  if (answer == QuickAnswer::kYes) answer = are_apart(a.start, b.end);
  return answer;
}

// The same for lanes that leave no pair.
template <typename Lanes = OneLane>
BROADSIDE_HD bool passes_by(const Manifold& start, const ContactShape& shape_a, const ContactPath& a,
                            const ContactShape& shape_b, const ContactPath& b, float reach_m, float near_m) {
  return whether_passes_by<Lanes>(start, shape_a, a, shape_b, b, reach_m, near_m) == QuickAnswer::kYes;
}

// For a patch that is kept because something may push a body there, although free motion passes it by: replaces its
// plane by the one that separates the bodies at the end of their free motion, if that plane separates them all the way.
// The new plane guards against the push, and does not stop bodies that pass by. Before, a cube that fell past the
// corner of another one at 4 m/s was stopped by the plane through that corner, 3 cm beside it. Only for boxes, because
// for them one direction tells whether a plane separates them. falls_m: a patch nearer than this may bear a resting
// body.
template <typename Lanes = OneLane>
BROADSIDE_HD void let_pass(Manifold& kept, const ContactShape& shape_a, const ContactPath& a,
                           const ContactShape& shape_b, const ContactPath& b, float reach_m, float falls_m) {
  if (!are_boxes(shape_a, shape_b) || !(least_gap_m(kept) > falls_m)) return;
  if (parts_ends(kept.normal, shape_a, a, shape_b, b)) return;
  Manifold end[kPatchesOfPair];
  const int count = make_manifolds<Lanes>(shape_a, a.end, shape_b, b.end, seen_reach_m(reach_m), end);
  if (count != 1) return;
  const Manifold& m = end[0];
  if (!(least_gap_m(m) > 0.0F) || !(dot(m.normal, kept.normal) > 0.0F)) return;
  if (!(gap_of_boxes(shape_a, a.start, shape_b, b.start, m.normal) > 0.0F)) return;
  if (!parts_ends(m.normal, shape_a, a, shape_b, b)) return;
  kept.normal = m.normal;
  kept.count = m.count;
  for (int k = 0; k < m.count; ++k) {
    const MovedBack at = moved_back(m.normal, m.points[k], a, b);
    kept.points[k] = {0.5F * (at.on_a + at.on_b), at.gap_m, m.points[k].feature};
  }
}

}  // namespace broadside::core
