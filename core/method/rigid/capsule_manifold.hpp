// A capsule against capsules, boxes and hulls: a segment as a polytope, with a ball around each of its points.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/point_nearest.hpp"
#include "core/method/rigid/polytope_axes.hpp"
#include "core/method/rigid/polytope_manifold.hpp"
#include "core/method/rigid/polytopes.hpp"

namespace broadside::core {

// The points of a manifold share one normal. The ends of a capsule's line are left out where the line, or the other
// surface, is tilted by more than 8 degrees (this cosine) against that normal: gaps along the common normal would then
// be off by more than 1 %.
inline constexpr float kSameNormal = 0.99F;

namespace capsule_detail {

// The point of a capsule's surface beside an end of its segment, on the side that looks in a direction. False if the
// segment is too steep against that direction.
BROADSIDE_HD bool line_end(const PlacedShape& capsule, int end, Vec3 towards, Vec3& out) {
  const Vec3 axis = capsule.axes[capsule.shape->axis];
  const Vec3 across = towards - dot(towards, axis) * axis;
  const float size = length(across);
  const float half = capsule.shape->half_length_m;
  out = capsule.center + (end == 0 ? -half : half) * axis + (capsule.shape->radius_m / size) * across;
  return size >= kSameNormal;
}

// Two capsules touch along a line where ends of one segment lie beside the other segment.
BROADSIDE_HD void capsules(const PlacedShape& a, const PlacedShape& b, float rounding_m, float reach_m, Manifold& out) {
  const SegmentPolytope sa = segment_polytope(a);
  const SegmentPolytope sb = segment_polytope(b);
  const float ball_a = a.shape->radius_m;
  const float ball_b = b.shape->radius_m;
  const NearestDirection direction = nearest_direction(sa, sb, {0.0F, 1.0F, 0.0F}, 0.0F, rounding_m, 3.0e38F);
  const NearestFeatures& near = direction.features;
  const float distance = sqrtf(near.squared_m2);
  out.count = 0;
  if (!(distance - (ball_a + ball_b) <= reach_m)) return;
  if (distance > rounding_m) {
    out.normal = direction.normal;
  } else {
    // Segments that cross are separated along the direction perpendicular to both; parallel ones along any direction
    // perpendicular to them.
    const Vec3 across = cross(sa.half, sb.half);
    const float squared = dot(across, across);
    const bool is_parallel =
        !(squared > kParallelSine * kParallelSine * (dot(sa.half, sa.half) * dot(sb.half, sb.half)));
    out.normal = is_parallel ? b.axes[b.shape->axis == 0 ? 1 : 0] : (1.0F / sqrtf(squared)) * across;
  }
  ManifoldPoint points[5];
  int count = 0;
  const ManifoldPoint nearest{distance > rounding_m
                                  ? middle_of(near.on_a, near.on_b, out.normal, distance, ball_a > ball_b)
                                  : 0.5F * (near.on_a + near.on_b),
                              distance, feature_key(near.name_a, near.name_b)};
  points[count++] = polytope_detail::with_balls(nearest, out.normal, ball_a, ball_b);
  for (int k = 0; k < 4; ++k) {
    const bool is_end_of_a = k < 2;
    const PlacedShape& other = is_end_of_a ? b : a;
    Vec3 p;
    if (!line_end(is_end_of_a ? a : b, k & 1, is_end_of_a ? -out.normal : out.normal, p)) continue;
    const PointDistance from = point_to_solid(other, p, rounding_m);
    const float gap = from.gap_m;
    const float turn = is_end_of_a ? 1.0F : -1.0F;
    if (!(turn * dot(from.normal, out.normal) >= kSameNormal)) continue;
    const std::uint32_t name = corner_name(static_cast<std::uint32_t>(k & 1));
    const std::uint32_t key = is_end_of_a ? feature_key(name, from.name) : feature_key(from.name, name);
    if (key == nearest.feature) continue;
    points[count++] = {p - (0.5F * gap) * from.normal, gap, key};
  }
  keep_four(out, count, reach_m, [&](int k) { return points[k]; });
}

// The deepest point is that of the segment with its ball. Where the capsule lies on a face, the line of its own surface
// is clipped by that face; where it lies on an edge, the two ends of the line are taken. distance(p): from a point to
// the other body.
template <typename Polytope, typename Distance>
BROADSIDE_HD void lying(const PlacedShape& capsule, const Polytope& other, float rounding_m, float reach_m,
                        const Distance& distance, Manifold& out) {
  if (out.count == 0) return;
  constexpr int kRoom = Polytope::kMostFaceCorners + 3;
  CommonArea<kRoom> area;
  ManifoldPoint deepest = out.points[0];
  for (int k = 1; k < out.count; ++k)
    if (is_better(-out.points[k].gap_m, out.points[k].feature, -deepest.gap_m, deepest.feature))
      deepest = out.points[k];
  Vec3 ends[2];
  const bool lies = line_end(capsule, 0, -out.normal, ends[0]) && line_end(capsule, 1, -out.normal, ends[1]);
  if (lies) {
    const SegmentPolytope line{0.5F * (ends[0] + ends[1]), 0.5F * (ends[1] - ends[0])};
    common_area(other, other.support_face(out.normal), line, 0, out.normal, false, rounding_m, area);
  }
  for (int end = 0; end < 2 && lies && area.count < 2; ++end) {
    const PointDistance from = distance(ends[end]);
    if (!(dot(from.normal, out.normal) >= kSameNormal)) continue;
    area.points[area.count++] = {ends[end] - (0.5F * from.gap_m) * from.normal, from.gap_m,
                                 feature_key(corner_name(static_cast<std::uint32_t>(end)), from.name)};
  }
  // The deepest point may be one of these already.
  int count = 0;
  for (int k = 0; k < area.count; ++k) {
    const Vec3 apart = area.points[k].point - deepest.point;
    if (area.points[k].feature == deepest.feature || dot(apart, apart) <= 16.0F * rounding_m * rounding_m) continue;
    area.points[count++] = area.points[k];
  }
  area.points[count++] = deepest;
  keep_four(out, count, reach_m, [&](int k) { return area.points[k]; });
}

}  // namespace capsule_detail

template <typename Lanes>
BROADSIDE_HD_CALLED void capsule_manifold(const PlacedShape& capsule, const PlacedShape& other, float rounding_m,
                                          float reach_m, Manifold& out) {
  const SegmentPolytope segment = segment_polytope(capsule);
  const float ball = capsule.shape->radius_m;
  out.count = 0;
  if (other.shape->kind == ContactKind::kCapsule)
    return capsule_detail::capsules(capsule, other, rounding_m, reach_m, out);
  if (other.shape->kind == ContactKind::kBox) {
    const BoxPolytope box = box_polytope(other);
    const SeparatingAxis axis = separating_axis(segment, box, rounding_m, reach_m + ball);
    polytope_manifold(segment, box, axis, ball, 0.0F, rounding_m, reach_m, out);
    return capsule_detail::lying(
        capsule, box, rounding_m, reach_m, [&](Vec3 p) { return point_to_box(other, p, rounding_m); }, out);
  }
  if constexpr (Lanes::kKnowsLongShapes)
    if (other.shape->kind == ContactKind::kHull) {
      const HullPolytope hull = hull_polytope(other);
      const SeparatingAxis axis = separating_axis(segment, hull, rounding_m, reach_m + ball);
      polytope_manifold(segment, hull, axis, ball, 0.0F, rounding_m, reach_m, out);
      capsule_detail::lying(
          capsule, hull, rounding_m, reach_m, [&](Vec3 p) { return point_to_hull(other, p, rounding_m); }, out);
    }
}

}  // namespace broadside::core
