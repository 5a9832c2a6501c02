// Signed distance of convex bodies in closed form: the arbiter of boxes, spheres, capsules and convex meshes.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/engine/narrow_phase.hpp"
#include "core/exact/triangle_distance.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::exact {

// Every such body is a core with a ball around each of its points: a point for a sphere, a segment for a capsule, the
// body itself and no ball for a box or a convex mesh.
struct ConvexCore {
  std::vector<Point> vertices;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<std::array<std::uint32_t, 3>> faces;  // none for a point or a segment
  std::vector<Point> normals;                       // of distinct faces, unit
  std::vector<Point> directions;                    // of distinct edges up to sign, unit
  double radius_m = 0.0;
};

// Nothing when the mesh is neither a primitive (core/scene/primitive.hpp) nor convex, and for cylinders, which are no
// core with a ball.
std::optional<ConvexCore> convex_core_of(const core::Mesh& mesh);

// Where a body is, in double: its origin, and its orientation as a quaternion w x y z of any length but zero.
struct Placement {
  Point origin;
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};

  [[nodiscard]] Point turned(Point p) const;
};

Placement to_placement(const core::Pose& pose);

// In double, with the orientation normalized in double: float quaternions are units only to 1e-7.
ConvexCore placed(const ConvexCore& core, const Placement& placement);
ConvexCore placed(const ConvexCore& core, const core::Pose& pose);

// distance < 0: the least depth, that is the shortest translation that parts the bodies. Normal: unit, from B to A, the
// direction of that translation of A; where several are equally short, the first found. The points are on the surfaces
// where bodies are apart, and supports along the normal where they overlap.
struct SignedDistance {
  double distance_m = 0.0;
  Point normal;
  Point on_a;
  Point on_b;
};

// The least depth of two convex polytopes is along a face's normal or across an edge of each (the faces of their
// difference), and their least distance between a vertex and a face or between two edges; all of them are tried.
SignedDistance signed_distance(const ConvexCore& a, const ConvexCore& b);

// The direction from B to A, among those across faces and edges, along which the gap between the cores is largest; the
// balls are not counted. For polytopes that are apart by less than their faces are long it keeps digits that the
// direction between nearest points loses. Cores without faces have none: -infinity.
struct Axis {
  double gap = -std::numeric_limits<double>::infinity();
  Point direction;
};
Axis widest_gap(const ConvexCore& a, const ConvexCore& b);

// By how much bodies overlap along a unit direction from B to A: how far A must move along it to part from B.
double overlap_along(const ConvexCore& a, const ConvexCore& b, Point direction);

}  // namespace broadside::exact
