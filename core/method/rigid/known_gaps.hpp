// Distances of two hulls at those poses of a step for which the patches of most pairs need them. On a GPU the lanes of
// a warp share the work of one pair's patches, but cannot share the search for a distance. So a lane finds the
// distances of a pair first, for as many pairs at once as there are lanes, and hands them on.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/hull_gap.hpp"
#include "core/method/rigid/quick_hulls.hpp"

namespace broadside::core {

struct KnownGaps {
  NearestOfHulls start;  // exact_hull_gap
  HullBounds deep_end;   // hull_bounds for end_patches.hpp: both where they end
};

// End patches less deep than this are not looked for: the patches of the start suffice.
BROADSIDE_HD float unseen_m(const ContactShape& a, const ContactShape& b) {
  constexpr float kUnseen = 0x1p-7F;
  return kUnseen * (b.kind == ContactKind::kHalfSpace ? a.size_m : fminf(a.size_m, b.size_m));
}

// Of hulls that have quick answers.
BROADSIDE_HD KnownGaps known_gaps(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                                  const ContactPath& b) {
  const PlacedShape start_a = placed_shape(shape_a, a.start, a.start.x);
  const PlacedShape start_b = placed_shape(shape_b, b.start, a.start.x);
  KnownGaps gaps;
  gaps.start = exact_hull_gap({shape_a.hull, start_a.center, start_a.axes},
                              {shape_b.hull, start_b.center, start_b.axes}, contact_rounding_m(start_a, start_b));
  gaps.deep_end = hull_bounds(shape_a, a.end, shape_b, b.end, -unseen_m(shape_a, shape_b));
  return gaps;
}

}  // namespace broadside::core
