// The contacts of two bodies: one entry for every pair of shapes. RIGID 8.4.
//
// The contract. Normals are units and point from B to A. A point's gap is at most reach_m. The deepest point of a
// convex pair has the signed distance of the bodies to contact_rounding_m. The four points of a patch do not depend on
// the order in which they were found. The numbers are finite for shapes that are turned, moved, tiny or huge. Only
// float32, + - * / and square root are used, and nothing is allocated, so the bits are the same on host and device.
#pragma once

#include "core/attributes.hpp"
#include "core/method/rigid/box_manifold.hpp"
#include "core/method/rigid/capsule_manifold.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cylinder_manifold.hpp"
#include "core/method/rigid/hull_manifold.hpp"
#include "core/method/rigid/lanes.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/mesh_manifold.hpp"
#include "core/method/rigid/plane_manifold.hpp"
#include "core/method/rigid/polytope_axes.hpp"
#include "core/method/rigid/polytope_manifold.hpp"
#include "core/method/rigid/separating_axis.hpp"
#include "core/method/rigid/sphere_manifold.hpp"

namespace broadside::core {

namespace manifold_detail {

// a is the shape of the lower kind.
template <typename Lanes>
BROADSIDE_HD_CALLED int ordered(const PlacedShape& a, const PlacedShape& b, float rounding_m, float reach_m,
                                Manifold* out) {
  out[0].count = 0;
  if constexpr (Lanes::kLeavesHardPairs) {
    if (b.shape->kind == ContactKind::kHalfSpace)
      plane_manifold<Lanes>(a, b, reach_m, out[0]);
    else
      hull_manifold(hull_polytope<Lanes>(a), hull_polytope<Lanes>(b), rounding_m, reach_m, out[0]);
    return out[0].count > 0 ? 1 : out[0].count;
  }
  const ContactKind kind = b.shape->kind;
  if constexpr (Lanes::kKnowsLongShapes) {
    if (kind == ContactKind::kMesh) return mesh_manifolds<Lanes>(a, b, rounding_m, reach_m, out);
    if (kind == ContactKind::kHalfSpace && a.shape->kind == ContactKind::kMesh) {
      mesh_plane_manifold(a, b, reach_m, out[0]);
      return out[0].count > 0 ? 1 : 0;
    }
    if (a.shape->kind == ContactKind::kBox && kind == ContactKind::kHull) {
      const BoxPolytope box = box_polytope(a);
      const auto hull = hull_polytope<Lanes>(b);
      const SeparatingAxis axis = separating_axis(box, hull, rounding_m, reach_m);
      polytope_manifold(box, hull, axis, 0.0F, 0.0F, rounding_m, reach_m, out[0]);
      return out[0].count > 0 ? 1 : 0;
    }
    if (a.shape->kind == ContactKind::kHull && kind == ContactKind::kHull) {
      hull_manifold(hull_polytope<Lanes>(a), hull_polytope<Lanes>(b), rounding_m, reach_m, out[0]);
      return out[0].count > 0 ? 1 : 0;
    }
  }
  if (kind == ContactKind::kHalfSpace) {
    plane_manifold<Lanes>(a, b, reach_m, out[0]);
  } else if (a.shape->kind == ContactKind::kSphere) {
    sphere_manifold(a, b, rounding_m, reach_m, out[0]);
  } else if (a.shape->kind == ContactKind::kCylinder) {
    cylinder_manifold<Lanes>(a, b, rounding_m, reach_m, out[0]);
  } else if (kind == ContactKind::kCylinder) {
    cylinder_manifold<Lanes>(b, a, rounding_m, reach_m, out[0]);
    turn_over(out[0]);
  } else if (a.shape->kind == ContactKind::kCapsule) {
    capsule_manifold<Lanes>(a, b, rounding_m, reach_m, out[0]);
  } else if (a.shape->kind == ContactKind::kBox && kind == ContactKind::kBox) {
    const SeparatingAxis axis = separating_axis_of_boxes(a, b, rounding_m, reach_m);
    box_manifold(box_polytope(a), box_polytope(b), axis, rounding_m, reach_m, out[0]);
  }
  return out[0].count > 0 ? 1 : 0;
}

}  // namespace manifold_detail

// Writes the patches of the pair to out[0 .. kPatchesOfPair) and returns how many there are. reach_m: points that are
// apart by up to this much count too, so that a solver can stop bodies before they touch. Lanes (lanes.hpp): all lanes
// make this call together; the result is kLeft if they leave the pair. known_gap: exact_hull_gap of the two hulls at
// these poses, or null.
template <typename Lanes = OneLane>
BROADSIDE_HD_CALLED int make_manifolds(const ContactShape& shape_a, const ContactPose& pose_a,
                                       const ContactShape& shape_b, const ContactPose& pose_b, float reach_m,
                                       Manifold* out, const NearestOfHulls* known_gap = nullptr) {
  PlacedShape a = placed_shape(shape_a, pose_a, pose_a.x);
  a.known_gap = known_gap;
  const PlacedShape b = placed_shape(shape_b, pose_b, pose_a.x);
  const float rounding_m = contact_rounding_m(a, b);
  if (shape_a.kind <= shape_b.kind) return manifold_detail::ordered<Lanes>(a, b, rounding_m, reach_m, out);
  const int count = manifold_detail::ordered<Lanes>(b, a, rounding_m, reach_m, out);
  for (int k = 0; k < count; ++k) turn_over(out[k]);
  return count;
}

}  // namespace broadside::core
