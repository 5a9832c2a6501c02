// Decisions about two finely cut hulls by bounds of their distance. Most pairs that may meet within a step do not, and
// bounds show that without making their patches. Bounds never decide differently than patches would: within rounding of
// a limit the answer is kUnknown.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/hull_gap.hpp"
#include "core/method/rigid/pushed_motion.hpp"

namespace broadside::core {

// Hulls with fewer pairs of edges are left out: their patches cost no more than bounds.
BROADSIDE_HD bool has_quick_answers(const ContactShape& a, const ContactShape& b) {
  constexpr std::uint32_t kManyEdgePairs = 4096;
  return a.kind == ContactKind::kHull && b.kind == ContactKind::kHull && a.hull.ways != nullptr &&
         b.hull.ways != nullptr && a.hull.edge_count * b.hull.edge_count > kManyEdgePairs;
}

struct HullBounds {
  HullGap gap;
  float rounding_m = 0.0F;
};

namespace quick_detail {

// Bounds are sums of a dozen roundings of the same lengths as a gap. This is four times what a gap itself is allowed.
inline constexpr float kMargin = 4.0F;
// Where the distance is below this many allowances, the normal of a patch and the direction between nearest points may
// differ by more than ten degrees: a gap is off by one allowance, and a direction by the root of twice that over the
// distance.
inline constexpr float kClearlyApart = 64.0F;
// Where the lower bound along a direction is less than the upper one by no more than this share, the direction is
// within ten degrees of that between the nearest points.
inline constexpr float kThin = 0x1p-6F;
// Each of two such normals is then within twenty degrees of the normal of a patch.
inline constexpr float kSameSide = 0.77F;
// The largest length of the difference between such a normal and that of a patch, both of length 1: 25 degrees apart.
inline constexpr float kNormalOff = 0.45F;

BROADSIDE_HD bool is_clear(const HullBounds& b) {
  return b.gap.least_m > kClearlyApart * b.rounding_m && b.gap.least_m >= (1.0F - 2.0F * kThin) * b.gap.most_m;
}

}  // namespace quick_detail

// Two hulls at given poses.
struct HullPair {
  PlacedHull a;
  PlacedHull b;
  float rounding_m = 0.0F;
};
BROADSIDE_HD HullPair hull_pair(const ContactShape& shape_a, const ContactPose& pose_a, const ContactShape& shape_b,
                                const ContactPose& pose_b) {
  const PlacedShape a = placed_shape(shape_a, pose_a, pose_a.x);
  const PlacedShape b = placed_shape(shape_b, pose_b, pose_a.x);
  return {{shape_a.hull, a.center, a.axes}, {shape_b.hull, b.center, b.axes}, contact_rounding_m(a, b)};
}

// Bounds as close as the answers below need them; a distance beyond stop_m is not refined.
BROADSIDE_HD HullBounds hull_bounds(const HullPair& pair, HullSearch& search, float stop_m) {
  search_on(pair.a.hull, pair.b.hull, search, stop_m + quick_detail::kMargin * pair.rounding_m, quick_detail::kThin,
            pair.rounding_m);
  return {gap_of(search, pair.a), pair.rounding_m};
}

// toward: where the search begins, as for begin_search.
BROADSIDE_HD_CALLED HullBounds hull_bounds(const ContactShape& shape_a, const ContactPose& pose_a,
                                           const ContactShape& shape_b, const ContactPose& pose_b, float stop_m,
                                           Vec3 toward = {}) {
  const HullPair pair = hull_pair(shape_a, pose_a, shape_b, pose_b);
  HullSearch search = begin_search(pair.a, pair.b, toward);
  return hull_bounds(pair, search, stop_m);
}

enum class QuickAnswer { kUnknown, kNo, kYes };

// Answers is_still_apart (passing_by.hpp) for two hulls, whose patch at the start has this normal. end: hull_bounds of
// the later poses, with reach_m.
BROADSIDE_HD QuickAnswer quickly_still_apart(Vec3 start_normal, const HullBounds& end, float reach_m) {
  using namespace quick_detail;
  const float margin_m = kMargin * end.rounding_m;
  if (end.gap.least_m > reach_m + margin_m || end.gap.overlap_m > margin_m) return QuickAnswer::kNo;
  if (!is_clear(end) || !(end.gap.most_m < reach_m - margin_m)) return QuickAnswer::kUnknown;
  const float same_side = dot(start_normal, end.gap.normal);
  if (same_side >= kSameSide) return QuickAnswer::kYes;
  return same_side <= -kSameSide ? QuickAnswer::kNo : QuickAnswer::kUnknown;
}

// Whether no point of two hulls has a gap of reach_m or less; reach_m may be negative. bounds: hull_bounds with
// reach_m.
BROADSIDE_HD bool surely_apart(const HullBounds& bounds, float reach_m) {
  return bounds.gap.least_m > reach_m + quick_detail::kMargin * bounds.rounding_m;
}

// The largest gap of patches that are looked for at later poses: large enough for two bodies that move apart by all of
// their reach.
BROADSIDE_HD float seen_reach_m(float reach_m) {
  return 2.0F * reach_m;
}

namespace quick_detail {

// Whether two bodies with these bounds at the start of a step have no patch there, or only one that passes_by drops.
// near: as for near_m. bounds_at(pose of a, pose of b, stop_m, toward): bounds at other poses.
template <typename BoundsAt>
BROADSIDE_HD bool surely_pass(const HullBounds& start, const ContactPath& a, const ContactPath& b, float reach_m,
                              const NearReach& near, const BoundsAt& bounds_at) {
  const float margin_m = kMargin * start.rounding_m;
  if (start.gap.least_m > reach_m + margin_m) return true;
  const Vec3 n = start.gap.normal;
  if (!is_clear(start) || !(start.gap.least_m > near_at_most_m(n, kNormalOff, near) + margin_m)) return false;
  const float seen_m = seen_reach_m(reach_m);
  const auto are_apart = [&](const ContactPose& at_a, const ContactPose& at_b) {
    return quickly_still_apart(n, bounds_at(at_a, at_b, seen_m, n), seen_m) == QuickAnswer::kYes;
  };
  return are_apart(a.end, b.end) && are_apart(a.end, b.start) && are_apart(a.start, b.end);
}

}  // namespace quick_detail

// For two hulls. pair and search: those at the start; the search may go on later from where it stops here.
BROADSIDE_HD bool surely_pass(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                              const ContactPath& b, const HullPair& pair, HullSearch& search, float reach_m,
                              const NearReach& near) {
  return quick_detail::surely_pass(hull_bounds(pair, search, reach_m), a, b, reach_m, near,
                                   [&](const ContactPose& at_a, const ContactPose& at_b, float stop_m, Vec3 toward) {
                                     return hull_bounds(shape_a, at_a, shape_b, at_b, stop_m, toward);
                                   });
}

}  // namespace broadside::core
