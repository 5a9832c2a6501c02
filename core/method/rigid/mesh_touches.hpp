// Points of a pair of meshes. They are found in any order; the deepest ones are kept, and then merged into patches by
// normal.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/capsule_manifold.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/lanes.hpp"
#include "core/method/rigid/manifold.hpp"

namespace broadside::core {

// The most patches of a pair of bodies. A convex pair has one patch; meshes have the four deepest ones with different
// normals.
inline constexpr int kPatchesOfPair = 4;

// Points whose normals are within 26 degrees (this cosine) of that of the deepest one are one patch.
inline constexpr float kSamePatch = 0.9F;

// Patches are made from this many points of a pair of meshes, the deepest ones.
inline constexpr int kMeshPoints = 48;

namespace mesh_detail {

struct Touch {
  Vec3 normal;
  ManifoldPoint point;
};

struct Touches {
  int count = 0;
  float shallowest_m = 3.402823e38F;  // once there is no room left, the gap of the least deep point
  Touch all[kMeshPoints];

  // Keeps the deepest points; the order of calls does not matter. A point that several triangles share is kept once,
  // with the normal of the deepest of them, or, of equally deep ones, of the lowest key.
  template <typename Lanes>
  BROADSIDE_HD void add(const Touch& t, float rounding_m) {
    // The last kept point that is at the same place as t, with the same normal.
    const FirstLeast same = Lanes::first_least(count, [&](int k) {
      const Vec3 apart = t.point.point - all[k].point.point;
      const bool is_same =
          dot(apart, apart) <= 16.0F * rounding_m * rounding_m && dot(t.normal, all[k].normal) >= kSameNormal;
      return is_same ? -static_cast<float>(k) : 3.402823e38F;
    });
    int place = same.value <= 0.0F ? same.item : count;
    if (place == kMeshPoints)  // the least deep one gives way
      place = Lanes::first_best(count, [&](int k) { return Rated{true, all[k].point.gap_m, ~all[k].point.feature}; });
    if (place < count && !is_deeper(t.point, all[place].point)) return;
    if (place == count) ++count;
    all[place] = t;
    if (count == kMeshPoints)
      shallowest_m = -Lanes::first_least(count, [&](int k) { return -all[k].point.gap_m; }).value;
  }

  // Nodes that are farther apart than this have only points for which there is no room. A point is at most 3 roundings
  // nearer than its surface, and boxes are off by one rounding; twice the sum of both is allowed for.
  BROADSIDE_HD float seen_m(float reach_m, float rounding_m) const {
    return fminf(reach_m, fmaxf(shallowest_m, 0.0F) + 8.0F * rounding_m);
  }
  BROADSIDE_HD static bool is_deeper(const ManifoldPoint& p, const ManifoldPoint& q) {
    return is_better(-p.gap_m, p.feature, -q.gap_m, q.feature);
  }
};

template <typename Lanes>
BROADSIDE_HD void take_all(const Manifold& m, float rounding_m, Touches& out) {
  for (int k = 0; k < m.count; ++k) out.add<Lanes>({m.normal, m.points[k]}, rounding_m);
}

// Makes the patches: the deepest point that has no patch yet begins one, together with all other such points that share
// its normal.
template <typename Lanes>
BROADSIDE_HD int patches_of(Touches& touches, float rounding_m, float reach_m, Manifold* out) {
  int patches = 0;
  bool is_taken[kMeshPoints] = {};
  while (patches < kPatchesOfPair) {
    const int deepest = Lanes::first_best(touches.count, [&](int k) {
      const ManifoldPoint& p = touches.all[k].point;
      return Rated{!is_taken[k], -p.gap_m, p.feature};
    });
    if (deepest < 0) break;
    Manifold& patch = out[patches++];
    patch.normal = touches.all[deepest].normal;
    bool is_of_patch[kMeshPoints] = {};
    for (int k = 0; k < touches.count; ++k) {
      is_of_patch[k] = !is_taken[k] && dot(touches.all[k].normal, patch.normal) >= kSamePatch;
      is_taken[k] |= is_of_patch[k];
    }
    keep_four_by<Lanes>(
        patch, touches.count, reach_m, 0.0F, [&](int k) { return touches.all[k].point; },
        [&](int k) { return is_of_patch[k]; }, 4.0F * rounding_m);
  }
  return patches;
}

}  // namespace mesh_detail

}  // namespace broadside::core
