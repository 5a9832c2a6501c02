// Where two shapes of plain-rigid touch or come near: points with normals and gaps.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "reference/plain_rigid/rigid_body.hpp"

namespace broadside::reference::plain {

// A point in the middle between the two surfaces.
struct NearPoint {
  Vec point;         // m
  Vec normal;        // unit, from B to A
  double gap = 0.0;  // m; negative is penetration
};

// Points whose gap is at most reach (m). A sphere has at most one. Two polytopes have the corners of the area that
// their faces share, or one point between two edges; a polytope against a face of the domain has its corners.
void near_points(const RigidBody& a, const RigidBody& b, double reach, std::vector<NearPoint>& out);
// The same for face 0 to 5 of the domain: -x +x -y +y -z +z.
void near_points(const RigidBody& a, const core::Box& domain, std::uint32_t face, double reach,
                 std::vector<NearPoint>& out);

}  // namespace broadside::reference::plain
