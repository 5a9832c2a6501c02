// Signed distance of convex bodies in closed form: the reference answer for boxes, spheres, capsules and convex meshes.
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

// Each of these bodies is a core with a ball around each of its points: a point for a sphere, a segment for a capsule,
// and for a box or a convex mesh the body itself without a ball.
struct ConvexCore {
  std::vector<Point> vertices;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<std::array<std::uint32_t, 3>> faces;  // none for a point or a segment
  std::vector<Point> normals;                       // one per distinct face normal, unit
  std::vector<Point> directions;                    // one per distinct edge direction up to sign, unit
  double radius_m = 0.0;
};

// Nothing when the mesh is neither a primitive (core/scene/primitive.hpp) nor convex, and nothing for cylinders, which
// are not a core with a ball.
std::optional<ConvexCore> convex_core_of(const core::Mesh& mesh);

// The position and orientation of a body in double: its origin, and a quaternion w x y z of any length but zero.
struct Placement {
  Point origin;
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};

  [[nodiscard]] Point turned(Point p) const;
};

Placement to_placement(const core::Pose& pose);

// Computed in double, and the orientation is normalized in double: float quaternions have unit length only to 1e-7.
ConvexCore placed(const ConvexCore& core, const Placement& placement);
ConvexCore placed(const ConvexCore& core, const core::Pose& pose);

// distance < 0: minus the least depth, which is the length of the shortest translation that separates the bodies.
// Normal: unit, from B to A, the direction of that translation of A; among equally short ones, the first found. The
// points are on the surfaces where the bodies are apart, and support points along the normal where they overlap.
struct SignedDistance {
  double distance_m = 0.0;
  Point normal;
  Point on_a;
  Point on_b;
};

// The least depth of two convex polytopes is along a face's normal or along a direction normal to an edge of each
// (these are the faces of their Minkowski difference). Their least distance is between a vertex and a face or between
// two edges. All of these are tried.
SignedDistance signed_distance(const ConvexCore& a, const ConvexCore& b);

// The direction from B to A with the largest gap between the cores, among face normals and directions normal to two
// edges; the balls are not counted. For polytopes whose distance is less than the size of their faces, it keeps digits
// that the direction between nearest points loses. Cores without faces have no such direction: -infinity.
struct Axis {
  double gap = -std::numeric_limits<double>::infinity();
  Point direction;
};
Axis widest_gap(const ConvexCore& a, const ConvexCore& b);

// How far the bodies overlap along a unit direction from B to A: the distance that A must move along it to separate
// from B.
double overlap_along(const ConvexCore& a, const ConvexCore& b, Point direction);

}  // namespace broadside::exact
