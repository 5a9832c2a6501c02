// The separating axis of two finely cut hulls that overlap, found from a common point: only faces and edges near that
// point can make the axis of least overlap.
//
// Along a unit direction n the overlap of A and B is the sum of how deep the point is in A and in B, each measured from
// the highest corner toward the other body. Neither is negative, and neither is less than the point's depth under the
// nearest face of that body. So a face of A is no better axis if the point is deeper under it than the best overlap so
// far, less the least depth in B. Along the directions of an edge, which lie between the normals of its two faces, the
// depth is a sine where it is positive: it is least at an end, so an edge matters only where one of its faces does.
// Bodies at rest overlap very little, and only three of the 649 faces of a bunny are as near as that.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/hull_climb.hpp"
#include "core/method/rigid/hull_gap.hpp"
#include "core/method/rigid/lanes.hpp"
#include "core/method/rigid/polytope_axes.hpp"
#include "core/method/rigid/polytopes.hpp"
#include "core/method/rigid/separating_axis.hpp"

namespace broadside::core {

namespace overlap_detail {

// If this many faces are near the point, which is all that a Handful holds, there may be more of them. The hulls are
// then deep in each other, or flat, and all faces are tried.
inline constexpr int kMostNearFaces = 32;

// The common point: the mean of the weighted sums of corners of either body, which differ by rounding alone; and half
// the distance between both sums.
struct CommonPoint {
  Vec3 x;
  float off_m = 0.0F;
};

template <typename Hull>
BROADSIDE_HD Vec3 weighed(const Hull& hull, const std::uint32_t* corners, const NearestCorners& near) {
  float sum = 0.0F;
  Vec3 x;
  for (int k = 0; k < near.count; ++k) {
    sum = sum + near.weights[k];
    x = x + near.weights[k] * hull.hull.vertices[corners[k]];
  }
  return hull.center + turned(hull.axes, (1.0F / sum) * x);
}

template <typename Hull>
BROADSIDE_HD CommonPoint common_point(const Hull& a, const Hull& b, const NearestCorners& near) {
  const Vec3 in_a = weighed(a, near.of_a, near);
  const Vec3 in_b = weighed(b, near.of_b, near);
  return {0.5F * (in_a + in_b), 0.5F * length(in_a - in_b)};
}

// One of the hulls, as seen from the common point.
template <typename Hull>
struct Around {
  const Hull& hull;
  Vec3 point;                // in body axes
  std::uint32_t corner = 0;  // near the point: where searches for other corners begin
  int nearest = 0;           // the face
  float inside_m = 0.0F;     // the point is at least this deep in the hull along every direction
  float most_m = 0.0F;       // faces do not matter if the point is deeper under them

  BROADSIDE_HD float depth(int face) const { return -hull.height_over(face, point); }
  BROADSIDE_HD std::uint32_t lowest(Vec3 direction, std::uint32_t from) const {
    return climb_down(hull.hull, hull.local(direction), from);
  }
};

struct NearFace {
  int face = 0;
  float depth_m = 0.0F;         // of the point under it
  float gap_m = -3.402823e38F;  // to the other hull, once it is measured
};

template <typename Hull>
using NearFaces = typename Hull::Lanes::template Handful<NearFace>;

// The faces under which the point is no deeper than most_m; False if there is none, or if there may be more than fit.
template <typename Hull>
BROADSIDE_HD_CALLED bool find_near_faces(const Around<Hull>& body, float most_m, NearFaces<Hull>& found) {
  (void)found.fill_with(
      0, body.hull.face_count(), [&](int k) { return body.depth(k) <= most_m; },
      [&](int k) {
        return NearFace{k, body.depth(k)};
      });
  return found.count > 0 && found.count < kMostNearFaces;
}

template <typename Hull>
BROADSIDE_HD void note_nearest(Around<Hull>& body, NearFace nearest, float off_m, float rounding_m) {
  body.nearest = nearest.face;
  // Near a sharp corner, a point that is slightly outside is farther from the hull than from each plane, but no farther
  // than from the sum of corners.
  body.inside_m = nearest.depth_m > rounding_m ? nearest.depth_m - rounding_m : -(off_m + rounding_m);
}

template <typename Hull>
BROADSIDE_HD NearFace nearest_of(const NearFaces<Hull>& near) {
  return near.at(near.first_least([](const NearFace& f) { return f.depth_m; }).item);
}

template <typename Hull>
BROADSIDE_HD NearFace nearest_of_all(const Around<Hull>& body) {
  const FirstLeast least = Hull::Lanes::first_least(body.hull.face_count(), [&](int k) { return body.depth(k); });
  return {least.item, least.value};
}

// How far the other hull is in front of a face; by one lane.
template <typename Hull>
BROADSIDE_HD_CALLED float gap_over(const Around<Hull>& reference, const Around<Hull>& other, int face) {
  const Vec3 out = reference.hull.face_normal(face);
  const auto lowest = static_cast<int>(other.lowest(out, other.corner));
  return other.hull.least_at(lowest, out) - reference.hull.face_height(face);
}

// Measures the faces that matter, and returns the one with the widest gap.
template <typename Hull>
BROADSIDE_HD_CALLED NearFace widest_of(const Around<Hull>& reference, const Around<Hull>& other,
                                       NearFaces<Hull>& near) {
  near.each_own([&](NearFace& f) {
    if (f.depth_m <= reference.most_m) f.gap_m = gap_over(reference, other, f.face);
  });
  return near.at(near.first_least([](const NearFace& f) { return -f.gap_m; }).item);
}

// Among the faces that were measured, the one that looks along a direction most.
template <typename Hull>
BROADSIDE_HD int facing(const Hull& hull, const NearFaces<Hull>& near, Vec3 direction) {
  const Vec3 local = hull.local(direction);
  const auto turned_away = [&](const NearFace& f) {
    return f.gap_m > -3.0e38F ? -dot(hull.hull.faces[f.face].normal, local) : 3.402823e38F;
  };
  return near.at(near.first_least(turned_away).item).face;
}

// Edges of the faces that matter, each once, by numbers of (face, side).
template <typename Hull>
struct NearEdges {
  const Around<Hull>& body;
  int faces[kMostNearFaces];
  int face_count = 0;
  int sides = 0;  // of the face with the most

  BROADSIDE_HD NearEdges(const Around<Hull>& around, const NearFaces<Hull>& near) : body(around) {
    near.each_in_turn([&](const NearFace& f) { return f.depth_m <= body.most_m; },
                      [&](const NearFace& f) {
                        const int own = body.hull.face_corner_count(f.face);
                        sides = own > sides ? own : sides;
                        faces[face_count++] = f.face;
                      });
  }
  [[nodiscard]] BROADSIDE_HD int count() const { return face_count * sides; }
  [[nodiscard]] BROADSIDE_HD bool has(int k) const {
    const int face = faces[k / sides];
    const int side = k % sides;
    if (side >= body.hull.face_corner_count(face)) return false;
    const int other = beyond(face, side);
    return !(other < face && body.depth(other) <= body.most_m);
  }
  [[nodiscard]] BROADSIDE_HD axes_detail::PlacedEdge make(int k) const {
    const int face = faces[k / sides];
    const int side = k % sides;
    axes_detail::PlacedEdge out;
    int from = 0;
    int to = 0;
    ends(face, side, from, to);
    out.index = k;
    out.start = body.hull.corner(from);
    out.along = body.hull.corner(to) - out.start;
    out.left = body.hull.face_normal(face);
    out.right = body.hull.face_normal(beyond(face, side));
    return out;
  }
  [[nodiscard]] BROADSIDE_HD std::uint32_t start(int k) const {
    return static_cast<std::uint32_t>(body.hull.face_corner(faces[k / sides], k % sides));
  }
  BROADSIDE_HD void corners(int k, int* from_to) const { ends(faces[k / sides], k % sides, from_to[0], from_to[1]); }

 private:
  [[nodiscard]] BROADSIDE_HD int beyond(int face, int side) const {
    const HullView& hull = body.hull.hull;
    return static_cast<int>(hull.beyond[hull.faces[face].first_corner + static_cast<std::uint32_t>(side)]);
  }
  BROADSIDE_HD void ends(int face, int side, int& from, int& to) const {
    from = body.hull.face_corner(face, side);
    to = body.hull.face_corner(face, side + 1 == body.hull.face_corner_count(face) ? 0 : side + 1);
  }
};

template <typename Hull>
BROADSIDE_HD_CALLED SeparatingAxis axis_of_edges(const NearEdges<Hull>& near_a, const NearEdges<Hull>& near_b) {
  using axes_detail::PlacedEdge;
  using Lanes = typename Hull::Lanes;
  SeparatingAxis edges;
  typename Lanes::template Handful<PlacedEdge> of_b;
  for (int j = 0; j < near_b.count();) {
    j = of_b.fill_with(
        j, near_b.count(), [&](int k) { return near_b.has(k); }, [&](int k) { return near_b.make(k); });
    if (of_b.count == 0) continue;
    const auto meet_edge = [&](const PlacedEdge& edge_a) {
      Vec3 n;
      const auto makes_axis = [&](const PlacedEdge& edge_b) {
        return axes_detail::across(edge_a, true, edge_b, true, n) && dot(n, edge_a.start - edge_b.start) > edges.gap_m;
      };
      of_b.each_in_turn(makes_axis, [&](const PlacedEdge& edge_b) {
        (void)axes_detail::across(edge_a, true, edge_b, true, n);
        const auto lowest_a = static_cast<int>(near_a.body.lowest(n, near_a.start(edge_a.index)));
        const auto lowest_b = static_cast<int>(near_b.body.lowest(-n, near_b.start(edge_b.index)));
        const float gap = near_a.body.hull.least_at(lowest_a, n) + near_b.body.hull.least_at(lowest_b, -n);
        if (gap > edges.gap_m) edges = {gap, n, AxisKind::kEdges, edge_a.index, edge_b.index};
      });
    };
    Lanes::template each_made<PlacedEdge>(
        near_a.count(), [&](int k) { return near_a.has(k); }, [&](int k) { return near_a.make(k); }, meet_edge);
  }
  return edges;
}

}  // namespace overlap_detail

// near: exact_hull_gap of hulls that have ways and are not clearly apart. False if the search has found no common
// point, or too many faces are near that point: then axis is not set. Like separating_axis it prefers a face whose gap
// is as wide to within rounding, and faces of A to faces of B.
template <typename Hull>
BROADSIDE_HD_CALLED bool overlap_axis(const Hull& a, const Hull& b, const NearestOfHulls& near, float rounding_m,
                                      SeparatingAxis& axis) {
  using namespace overlap_detail;
  if (near.corners.count == 0 || near.gap.least_m > kClearlyApartRoundings * rounding_m) return false;
  const CommonPoint p = common_point(a, b, near.corners);
  if (!(p.off_m < 3.0e38F)) return false;  // weights of a sliver may be anything
  // The bodies overlap no more than along the axis that the search for the point ended with, so a face does not matter
  // if the point is deeper under it than that.
  const float first_m = -near.gap.least_m;
  const float farthest_m = first_m + p.off_m + 3.0F * rounding_m;
  Around<Hull> in_a{a, a.local_point(p.x), near.corners.of_a[0]};
  Around<Hull> in_b{b, b.local_point(p.x), near.corners.of_b[0]};
  NearFaces<Hull> faces_a;
  NearFaces<Hull> faces_b;
  const bool are_few = find_near_faces(in_a, farthest_m, faces_a) && find_near_faces(in_b, farthest_m, faces_b);
  note_nearest(in_a, are_few ? nearest_of<Hull>(faces_a) : nearest_of_all(in_a), p.off_m, rounding_m);
  note_nearest(in_b, are_few ? nearest_of<Hull>(faces_b) : nearest_of_all(in_b), p.off_m, rounding_m);
  const auto keep_to = [&](float overlap_m) {
    in_a.most_m = (overlap_m - in_b.inside_m) + rounding_m;
    in_b.most_m = (overlap_m - in_a.inside_m) + rounding_m;
  };
  // They overlap no more than along the axes of the nearest faces, either.
  const float of_nearest_m =
      Hull::Lanes::first_least(2, [&](int k) {
        return k == 0 ? -gap_over(in_a, in_b, in_a.nearest) : -gap_over(in_b, in_a, in_b.nearest);
      }).value;
  keep_to(fminf(of_nearest_m, first_m));
  if (!are_few && (!find_near_faces(in_a, in_a.most_m, faces_a) || !find_near_faces(in_b, in_b.most_m, faces_b)))
    return false;
  const NearFace of_a = widest_of(in_a, in_b, faces_a);
  const NearFace of_b = widest_of(in_b, in_a, faces_b);
  if (!(of_a.gap_m > -3.0e38F) || !(of_b.gap_m > -3.0e38F)) return false;  // rounding left none
  axis = {of_a.gap_m, -a.face_normal(of_a.face), AxisKind::kFaceOfA, of_a.face, 0};
  if (of_b.gap_m > of_a.gap_m + rounding_m)
    axis = {of_b.gap_m, b.face_normal(of_b.face), AxisKind::kFaceOfB, 0, of_b.face};
  keep_to(fminf(-fmaxf(of_a.gap_m, of_b.gap_m), -near.gap.least_m));
  const NearEdges<Hull> edges_a(in_a, faces_a);
  const NearEdges<Hull> edges_b(in_b, faces_b);
  SeparatingAxis edges = axis_of_edges(edges_a, edges_b);
  if (edges.gap_m > axis.gap_m + rounding_m) {
    edges_a.corners(edges.of_a, edges.ends_of_a);
    edges_b.corners(edges.of_b, edges.ends_of_b);
    edges.has_ends = true;
    axis = edges;
  }
  axis.has_faces = true;
  axis.face_of_a = axis.kind == AxisKind::kFaceOfA ? of_a.face : facing(a, faces_a, -axis.normal);
  axis.face_of_b = axis.kind == AxisKind::kFaceOfB ? of_b.face : facing(b, faces_b, axis.normal);
  return true;
}

}  // namespace broadside::core
