// What bounds of the distance of two finely cut hulls tell of them: most pairs that may meet within a step do not, and
// need no patches to see it. Nothing is decided that patches would decide otherwise: where bounds are nearer to a limit
// than rounding, the answer is that they do not know.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/hull_gap.hpp"

namespace broadside::core {

struct ContactPath {
  ContactPose start;
  ContactPose end;  // if it touches nothing
};

// With fewer pairs of edges their patches cost no more than bounds.
BROADSIDE_HD bool has_quick_answers(const ContactShape& a, const ContactShape& b) {
  constexpr std::uint32_t kManyEdgePairs = 4096;
  return a.kind == ContactKind::kHull && b.kind == ContactKind::kHull && a.hull.ways != nullptr &&
         b.hull.ways != nullptr && a.hull.edge_count * b.hull.edge_count > kManyEdgePairs;
}

namespace quick_detail {

// Bounds are sums of a dozen roundings of the same lengths as a gap, whose own allowance this is four times.
inline constexpr float kMargin = 4.0F;
// Nearer than so many allowances the normal of a patch and the direction between nearest points may differ by more than
// ten degrees: a gap is off by an allowance, a direction by the root of twice that over the distance.
inline constexpr float kClearlyApart = 64.0F;
// Directions along which the lower bound is all but this of the upper one are within ten degrees of that between
// nearest points.
inline constexpr float kThin = 0x1p-6F;
// Two normals are then each within twenty degrees of what patches say.
inline constexpr float kSameSide = 0.77F;

struct Bounds {
  HullGap gap;
  float rounding_m = 0.0F;
};

BROADSIDE_HD Bounds bounds_of(const ContactShape& shape_a, const ContactPose& pose_a, const ContactShape& shape_b,
                              const ContactPose& pose_b, float stop_m) {
  const PlacedShape a = placed_shape(shape_a, pose_a, pose_a.x);
  const PlacedShape b = placed_shape(shape_b, pose_b, pose_a.x);
  Bounds out;
  out.rounding_m = contact_rounding_m(a, b);
  out.gap = hull_gap({a.shape->hull, a.center, a.axes}, {b.shape->hull, b.center, b.axes},
                     stop_m + kMargin * out.rounding_m, kThin, out.rounding_m);
  return out;
}

BROADSIDE_HD bool is_clear(const Bounds& b) {
  return b.gap.least_m > kClearlyApart * b.rounding_m && b.gap.least_m >= (1.0F - 2.0F * kThin) * b.gap.most_m;
}

}  // namespace quick_detail

enum class QuickAnswer { kUnknown, kNo, kYes };

// is_still_apart (passing_by.hpp) of two hulls, whose patch of the start has this normal.
BROADSIDE_HD QuickAnswer quickly_still_apart(Vec3 start_normal, const ContactShape& shape_a, const ContactPose& a,
                                             const ContactShape& shape_b, const ContactPose& b, float reach_m) {
  using namespace quick_detail;
  const Bounds end = bounds_of(shape_a, a, shape_b, b, reach_m);
  const float margin_m = kMargin * end.rounding_m;
  if (end.gap.least_m > reach_m + margin_m || end.gap.overlap_m > margin_m) return QuickAnswer::kNo;
  if (!is_clear(end) || !(end.gap.most_m < reach_m - margin_m)) return QuickAnswer::kUnknown;
  const float same_side = dot(start_normal, end.gap.normal);
  if (same_side >= kSameSide) return QuickAnswer::kYes;
  return same_side <= -kSameSide ? QuickAnswer::kNo : QuickAnswer::kUnknown;
}

// Whether no point of two hulls has a gap of reach_m or less; that may be negative.
BROADSIDE_HD bool surely_apart(const ContactShape& shape_a, const ContactPose& a, const ContactShape& shape_b,
                               const ContactPose& b, float reach_m) {
  using namespace quick_detail;
  const Bounds bounds = bounds_of(shape_a, a, shape_b, b, reach_m);
  return bounds.gap.least_m > reach_m + kMargin * bounds.rounding_m;
}

// Whether two hulls have no patch at the start of a step, or only one that passes_by drops. near_m: no patch that is
// farther is kept for being near, whatever its normal.
BROADSIDE_HD_CALLED bool surely_pass(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                                     const ContactPath& b, float reach_m, float near_m) {
  using namespace quick_detail;
  const Bounds start = bounds_of(shape_a, a.start, shape_b, b.start, reach_m);
  const float margin_m = kMargin * start.rounding_m;
  if (start.gap.least_m > reach_m + margin_m) return true;
  if (!is_clear(start) || !(start.gap.least_m > near_m + margin_m)) return false;
  const float seen_m = 2.0F * reach_m;
  const Vec3 n = start.gap.normal;
  return quickly_still_apart(n, shape_a, a.end, shape_b, b.end, seen_m) == QuickAnswer::kYes &&
         quickly_still_apart(n, shape_a, a.end, shape_b, b.start, seen_m) == QuickAnswer::kYes &&
         quickly_still_apart(n, shape_a, a.start, shape_b, b.end, seen_m) == QuickAnswer::kYes;
}

}  // namespace broadside::core
