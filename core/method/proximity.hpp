// Vertex proximity, P(7) and P(8): METHOD section 3.
#pragma once

#include <cstdint>
#include <limits>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/parameters.hpp"

namespace broadside::core {

// The nearest vertices of one confirmed pair, if nearer than theta. Indices are into each body's mesh. Ties go to the
// lowest vertex of A, then of B, so that the result does not depend on the order of visiting. Not touching: the squared
// distance is infinite.
struct Proximity {
  float squared_distance_m2 = std::numeric_limits<float>::infinity();
  std::uint32_t vertex_a = 0xFFFFFFFFU;
  std::uint32_t vertex_b = 0xFFFFFFFFU;

  BROADSIDE_HD bool is_touching() const { return vertex_a != 0xFFFFFFFFU; }
  friend constexpr bool operator==(const Proximity&, const Proximity&) = default;
};

// The order by which the nearest pair is chosen; every traversal of every engine reduces with it.
BROADSIDE_HD bool is_nearer(const Proximity& p, const Proximity& q) {
  if (p.squared_distance_m2 != q.squared_distance_m2) return p.squared_distance_m2 < q.squared_distance_m2;
  if (p.vertex_a != q.vertex_a) return p.vertex_a < q.vertex_a;
  return p.vertex_b < q.vertex_b;
}

// The distance below which vertices of two meshes touch: the scene's, or the mean of both mean edge lengths.
BROADSIDE_HD float pair_theta_m(const Parameters& parameters, float mean_edge_a_m, float mean_edge_b_m) {
  return parameters.theta_m > 0.0F ? parameters.theta_m : 0.5F * (mean_edge_a_m + mean_edge_b_m);
}

BROADSIDE_HD float squared_distance(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return dot(d, d);
}

// True when no point of box a and no point of box b can count as nearer than theta, in the arithmetic of
// squared_distance. Rounding is monotone, so a gap that rounds to at least theta on one axis makes the rounded square
// at least the rounded theta squared. Skipping such boxes therefore never changes a result.
// Here we depart from the paper: P-Alg A2 keeps only vertices inside boxes that overlap exactly, and so can miss the
// nearest vertices when they are in boxes that are less than theta apart.
BROADSIDE_HD bool apart_by(const Box& a, const Box& b, float theta_m) {
  return a.min.x - b.max.x >= theta_m || b.min.x - a.max.x >= theta_m || a.min.y - b.max.y >= theta_m ||
         b.min.y - a.max.y >= theta_m || a.min.z - b.max.z >= theta_m || b.min.z - a.max.z >= theta_m;
}

}  // namespace broadside::core
