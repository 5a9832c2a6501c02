// Distances of two hulls at the poses of a step at which the patches of most pairs need them. On a GPU the lanes of a
// warp share the work of one pair's patches, but cannot share the search for a distance. So each lane first finds the
// distances of a pair of its own, for as many pairs at once as there are lanes, and passes them on.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/hull_gap.hpp"
#include "core/method/rigid/lanes.hpp"
#include "core/method/rigid/pushed_motion.hpp"
#include "core/method/rigid/quick_boxes.hpp"
#include "core/method/rigid/quick_hulls.hpp"
#include "core/method/rigid/quick_rounds.hpp"

namespace broadside::core {

struct alignas(16) KnownGaps {
  bool are_known = false;
  NearestOfHulls start;  // exact_hull_gap
  HullBounds deep_end;   // hull_bounds where both end, for end_patches.hpp; only of bodies that turn enough
};

// End patches less deep than this are not looked for: the patches of the start suffice.
BROADSIDE_HD float unseen_m(const ContactShape& a, const ContactShape& b) {
  constexpr float kUnseen = 0x1p-7F;
  return kUnseen * (b.kind == ContactKind::kHalfSpace ? a.size_m : fminf(a.size_m, b.size_m));
}

// A pair before its patches are made. swing_m: how far turning moves points of both bodies. may_pass: if false, whether
// the bodies pass by each other is not tested.
struct PairAhead {
  float reach_m = 0.0F;
  NearReach near;
  float swing_m = 0.0F;
  bool may_pass = true;
};

// Whether two hulls that have quick answers surely pass by each other. If not, sets gaps.
BROADSIDE_HD_CALLED bool hulls_surely_pass(const ContactShape& shape_a, const ContactPath& a,
                                           const ContactShape& shape_b, const ContactPath& b, const PairAhead& ahead,
                                           KnownGaps& gaps) {
  const HullPair pair = hull_pair(shape_a, a.start, shape_b, b.start);
  HullSearch search = begin_search(pair.a, pair.b, {});
  if (ahead.may_pass && surely_pass(shape_a, a, shape_b, b, pair, search, ahead.reach_m, ahead.near)) return true;
  gaps.are_known = true;
  gaps.start = exact_hull_gap(pair.a, pair.b, search, pair.rounding_m);
  const float unseen = unseen_m(shape_a, shape_b);
  if (ahead.swing_m > unseen)
    gaps.deep_end = hull_bounds(shape_a, a.end, shape_b, b.end, -unseen, gaps.start.gap.normal);
  return false;
}

// Whether no patch of a pair leads to a contact in this step; decided without making the patches. If one may, gaps has
// the distances that were found on the way.
template <typename Lanes = OneLane>
BROADSIDE_HD bool surely_passes(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                                const ContactPath& b, const PairAhead& ahead, KnownGaps& gaps) {
  gaps.are_known = false;
  if (are_boxes(shape_a, shape_b))
    return ahead.may_pass && boxes_surely_pass(shape_a, a, shape_b, b, ahead.reach_m, near_at_most_m(ahead.near));
  if (has_round_answers(shape_a, shape_b))
    return ahead.may_pass && rounds_surely_pass(shape_a, a, shape_b, b, ahead.reach_m, ahead.near);
  if constexpr (Lanes::kKnowsLongShapes)
    if (has_quick_answers(shape_a, shape_b)) return hulls_surely_pass(shape_a, a, shape_b, b, ahead, gaps);
  return false;
}

}  // namespace broadside::core
