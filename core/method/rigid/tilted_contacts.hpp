// Where two round polytopes would touch next if they tilted a little: more points for their manifold.
//
// Faces of a finely cut hull are small, so what two of them have in common is a spot. Bodies that roll over each other
// within a step leave it, and meet half their size away, where no point was: bunnies in a heap ended 8 cm deep in each
// other. Bullet tilts a body and detects again (btConvexConvexAlgorithm, its perturbed manifold); here the corners that
// are lowest along tilted directions are looked up, with their gaps as the bodies stand.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/corner_layer.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/face_clipping.hpp"
#include "core/method/rigid/manifold.hpp"

namespace broadside::core {

// In four directions across the normal, by each of two tangents of angles: the larger is that of half a radian.
inline constexpr int kTilts = 8;
inline constexpr float kLargestTilt = 0.5F;

// How far x, a point of the other body, is above this one along the unit direction up; negative inside. False where the
// line through x misses the body, or meets a face too steep for the height to be a gap.
template <typename Polytope>
BROADSIDE_HD bool height_above(const Polytope& body, Vec3 x, Vec3 up, float& height_m) {
  using Lanes = typename Polytope::Lanes;
  float entry = -3.402823e38F;
  float facing = 0.0F;
  float exit = 3.402823e38F;
  float outside = 0.0F;
  float along = 0.0F;
  const auto look_at = [&](int k) {
    const Vec3 n = body.face_normal(k);
    outside = dot(n, x) - body.face_height(k);
    along = dot(n, up);
  };
  const auto is_above_entry = [&](int k) {
    look_at(k);
    if (along < 0.0F) exit = fminf(exit, outside / along);
    // Outside a face that is parallel to it, the line misses.
    if (along == 0.0F && outside > 0.0F) exit = -HUGE_VALF;
    return along > 0.0F && outside > entry * along;
  };
  Lanes::each_in_turn(body.face_count(), is_above_entry, [&](int k) {
    look_at(k);
    entry = outside / along;
    facing = along;
  });
  exit = Lanes::least_of_lanes(exit);
  height_m = entry;
  return entry <= exit && facing >= kSteepestReference;
}

struct TiltedContacts {
  int count = 0;
  ManifoldPoint points[2 * kTilts];
};

// normal: unit, from B to A.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED void tilted_contacts(const PolytopeA& a, const PolytopeB& b, Vec3 normal, Vec3 across,
                                         TiltedContacts& out) {
  out.count = 0;
  const Vec3 other = cross(normal, across);
  // The corner of a body that is lowest along a direction, and its height above the other body.
  const auto add = [&](const auto& body, const auto& below, Vec3 up, Vec3 tilted, bool is_a) {
    const int corner = lowest_corner(body, tilted);
    const auto name = corner_name(static_cast<std::uint32_t>(corner));
    const std::uint32_t key = is_a ? feature_key(name, face_name(0)) : feature_key(face_name(0), name);
    for (int k = 0; k < out.count; ++k)
      if (out.points[k].feature == key) return;
    const Vec3 x = body.corner(corner);
    float gap = 0.0F;
    if (height_above(below, x, up, gap)) out.points[out.count++] = {x - (0.5F * gap) * up, gap, key};
  };
  for (int k = 0; k < kTilts; ++k) {
    const float size = k < kTilts / 2 ? kLargestTilt : 0.25F * kLargestTilt;
    const Vec3 way = ((k & 1) != 0 ? -size : size) * ((k & 2) != 0 ? other : across);
    add(a, b, normal, normal + way, true);
    add(b, a, -normal, way - normal, false);
  }
}

}  // namespace broadside::core
