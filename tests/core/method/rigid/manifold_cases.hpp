// Pairs of shapes for the tests of manifolds: what the formulas are given, and the same bodies for the exact arbiter.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/exact/convex_core.hpp"
#include "core/exact/convex_hull.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/scene/hull_faces.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

struct Subject {
  ContactShape shape;
  exact::ConvexCore truth;
  ContactPose pose;
  std::shared_ptr<const HullTables> tables;  // of a hull: what the shape's view points into

  [[nodiscard]] exact::ConvexCore placed() const {
    return exact::placed(truth, exact::Placement{exact::to_point(pose.x), {pose.q.w, pose.q.x, pose.q.y, pose.q.z}});
  }
};

inline Mesh box_mesh(Vec3 half) {
  Mesh mesh;
  for (unsigned c = 0; c < 8; ++c)
    mesh.vertices.push_back(
        {(c & 1U) != 0 ? half.x : -half.x, (c & 2U) != 0 ? half.y : -half.y, (c & 4U) != 0 ? half.z : -half.z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline Subject box(Vec3 half) {
  Subject out;
  out.shape.kind = ContactKind::kBox;
  out.shape.half = half;
  out.shape.size_m = length(half);
  out.truth = *exact::convex_core_of(box_mesh(half));
  return out;
}

// A sphere has half_length 0; its axis does not matter.
inline Subject ball_on_segment(ContactKind kind, float radius, float half_length, int axis) {
  Subject out;
  out.shape.kind = kind;
  out.shape.axis = axis;
  out.shape.radius_m = radius;
  out.shape.half_length_m = half_length;
  out.shape.size_m = radius + half_length;
  out.truth.radius_m = radius;
  if (half_length == 0.0F) {
    out.truth.vertices.push_back({});
    return out;
  }
  const exact::Point along = exact::to_point(axis_vector(axis, 1.0F));
  out.truth.vertices = {-static_cast<double>(half_length) * along, static_cast<double>(half_length) * along};
  out.truth.edges.emplace_back(0, 1);
  out.truth.directions.push_back(along);
  return out;
}
inline Subject sphere(float radius) {
  return ball_on_segment(ContactKind::kSphere, radius, 0.0F, 0);
}
inline Subject capsule(float radius, float half_length, int axis) {
  return ball_on_segment(ContactKind::kCapsule, radius, half_length, axis);
}

// The mesh: closed and convex.
inline Subject hull(const Mesh& mesh) {
  Subject out;
  const auto tables = std::make_shared<const HullTables>(hull_tables(mesh));
  out.tables = tables;
  out.shape.kind = ContactKind::kHull;
  out.shape.hull = {tables->vertices.data(),
                    tables->faces.data(),
                    tables->corners.data(),
                    tables->edges.data(),
                    tables->ways.data(),
                    tables->guide.data(),
                    tables->beyond.data(),
                    static_cast<std::uint32_t>(tables->vertices.size()),
                    static_cast<std::uint32_t>(tables->faces.size()),
                    static_cast<std::uint32_t>(tables->edges.size())};
  for (const Vec3 v : tables->vertices) out.shape.size_m = std::max(out.shape.size_m, length(v));
  out.truth = *exact::convex_core_of(mesh);
  return out;
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  Vec3 in_cube(float half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Quat turn() {
    std::normal_distribution<double> normal;
    const double w = normal(random_), x = normal(random_), y = normal(random_), z = normal(random_);
    const double size = std::sqrt(w * w + x * x + y * y + z * z);
    return {static_cast<float>(w / size), static_cast<float>(x / size), static_cast<float>(y / size),
            static_cast<float>(z / size)};
  }
  // A random turn that takes axes to axes, so that faces and edges are parallel.
  Quat quarter_turns() {
    const float half = std::sqrt(0.5F);
    const Quat turns[] = {{1, 0, 0, 0},       {half, half, 0, 0}, {half, 0, half, 0},
                          {half, 0, 0, half}, {0, 1, 0, 0},       {0.5F, 0.5F, 0.5F, 0.5F}};
    return turns[below(6)];
  }

 private:
  std::mt19937_64 random_;
};

// The hull of so many points of an ellipsoid, turned at random.
inline Subject cut_ellipsoid(Draw& draw, Vec3 half, int corners) {
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) {
    const Vec3 p = normalized(draw.in_cube(1.0F));
    points.push_back({half.x * p.x, half.y * p.y, half.z * p.z});
  }
  Subject out = hull(*exact::convex_hull(points));
  out.pose.q = draw.turn();
  return out;
}

// Rounding of gaps, from the lengths that go into them: kContactRoundings of 2^-24, by its own count here.
inline double rounding_of(const Subject& a, const Subject& b) {
  const exact::Point d = exact::to_point(b.pose.x) - exact::to_point(a.pose.x);
  const double lengths = std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + a.shape.size_m + b.shape.size_m;
  return 32.0 * 0x1p-24 * lengths;
}

inline exact::Point at_world(const Subject& a, Vec3 relative) {
  return exact::to_point(a.pose.x) + exact::to_point(relative);
}

// The distance of a point from a body's surface, on either side.
inline double off_surface(const Subject& s, exact::Point p) {
  exact::ConvexCore alone;
  alone.vertices = {p};
  return std::abs(exact::signed_distance(alone, s.placed()).distance_m);
}

// Checks everything that is promised for a pair of convex bodies. Three roundings are allowed: that of the gap itself,
// that by which a later axis must be wider before it is taken, and that within which a side counts as touched.
inline testing::AssertionResult is_right(const Subject& a, const Subject& b, float reach_m, const Manifold* given,
                                         int count) {
  const auto wrong = [] { return testing::AssertionFailure(); };
  const double rounding = 3.0 * rounding_of(a, b);
  const exact::ConvexCore placed_a = a.placed();
  const exact::ConvexCore placed_b = b.placed();
  const exact::SignedDistance truth = exact::signed_distance(placed_a, placed_b);
  if (count == 0) {
    if (truth.distance_m > reach_m - rounding) return testing::AssertionSuccess();
    return wrong() << "no points at a distance of " << truth.distance_m << " m";
  }
  const Manifold& m = given[0];
  if (count != 1 || m.count < 1 || m.count > kManifoldPoints) return wrong() << "counts " << count << ", " << m.count;
  const exact::Point n = exact::to_point(m.normal);
  if (!(std::abs(std::sqrt(dot(n, n)) - 1.0) < 8.0 * 0x1p-24))
    return wrong() << "normal of length " << std::sqrt(dot(n, n));
  const double along = -exact::overlap_along(placed_a, placed_b, n);
  // Faces over each other may stand for nearest points beside them where they are as near to within a sixteenth.
  const bool has_faces = a.truth.radius_m == 0.0 && b.truth.radius_m == 0.0;
  const double share = has_faces && truth.distance_m > 0.0 ? truth.distance_m / 16.0 : 0.0;
  // Apart, a direction between nearest points is off by their rounding over the distance, which is second order here.
  if (!(along > truth.distance_m - share - 2.0 * rounding))
    return wrong() << "gap " << along << " m along the normal, truth " << truth.distance_m << " m, rounding "
                   << rounding;
  double least = 1e30;
  for (int k = 0; k < m.count; ++k) {
    const ManifoldPoint& p = m.points[k];
    if (p.feature == 0) return wrong() << "a feature 0";
    for (int other = 0; other < k; ++other)
      if (m.points[other].feature == p.feature) return wrong() << "a feature twice";
    if (!(p.gap_m <= reach_m)) return wrong() << "gap " << p.gap_m << " m beyond the reach";
    least = std::min(least, static_cast<double>(p.gap_m));
    const exact::Point middle = at_world(a, p.point);
    const double off_a = off_surface(a, middle + (0.5 * p.gap_m) * n);
    const double off_b = off_surface(b, middle - (0.5 * p.gap_m) * n);
    // Points at the ends of a capsule have normals of their own, up to 8 degrees (0.1411) from the common one.
    const bool is_capsule = a.shape.kind == ContactKind::kCapsule || b.shape.kind == ContactKind::kCapsule;
    const double off = 2.0 * rounding + (is_capsule ? 0.5 * 0.1411 * std::abs(p.gap_m) : 0.0);
    if (!(off_a <= off))
      return wrong() << "point " << k << " of " << m.count << ", gap " << p.gap_m << " m, is " << off_a
                     << " m off A, rounding " << rounding;
    if (!(off_b <= off))
      return wrong() << "point " << k << " of " << m.count << ", gap " << p.gap_m << " m, is " << off_b
                     << " m off B, rounding " << rounding;
  }
  if (!(least >= truth.distance_m - rounding && least <= truth.distance_m + share + rounding))
    return wrong() << "gap " << least << " m, truth " << truth.distance_m << " m, rounding " << rounding;
  return testing::AssertionSuccess();
}

inline testing::AssertionResult is_right(const Subject& a, const Subject& b, float reach_m) {
  Manifold out[kPatchesOfPair];
  const int count = make_manifolds(a.shape, a.pose, b.shape, b.pose, reach_m, out);
  return is_right(a, b, reach_m, out, count);
}

inline std::string text_of(const Subject& s) {
  std::string out = "kind " + std::to_string(static_cast<int>(s.shape.kind));
  const auto add = [&](const char* name, std::initializer_list<float> values) {
    out += std::string(" ") + name;
    char text[32];
    for (const float v : values) {
      std::snprintf(text, sizeof text, " %a", static_cast<double>(v));
      out += text;
    }
  };
  out += " axis " + std::to_string(s.shape.axis);
  add("half", {s.shape.half.x, s.shape.half.y, s.shape.half.z, s.shape.radius_m, s.shape.half_length_m});
  add("x", {s.pose.x.x, s.pose.x.y, s.pose.x.z});
  add("q", {s.pose.q.w, s.pose.q.x, s.pose.q.y, s.pose.q.z});
  return out;
}

}  // namespace broadside::core
