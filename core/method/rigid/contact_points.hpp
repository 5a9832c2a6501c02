// Candidates for the points of one manifold, and the four that are kept.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// Names of the parts of one shape, all different: its corner, its edge between two corners, its face.
BROADSIDE_HD constexpr std::uint32_t corner_name(std::uint32_t corner) {
  return corner;
}
BROADSIDE_HD constexpr std::uint32_t face_name(std::uint32_t face) {
  return 0x80000000U | face;
}
BROADSIDE_HD constexpr std::uint32_t edge_name(std::uint32_t p, std::uint32_t q) {
  const auto mixed = static_cast<std::uint32_t>(splitmix64(pair_key(make_pair_of(p, q))));
  return 0x40000000U | (mixed & 0x3FFFFFFFU);
}

// The key of two parts that meet. Mixed from both names: two of the few points of a pair share a key in one of 2^30
// cases, and then one of them starts from the other's impulse.
BROADSIDE_HD constexpr std::uint32_t feature_key(std::uint32_t of_a, std::uint32_t of_b) {
  const auto key = static_cast<std::uint32_t>(splitmix64((static_cast<std::uint64_t>(of_a) << 32) | of_b) >> 32);
  return key == 0 ? 1U : key;
}

// Larger first; of equal ones the lower key, so that the order of candidates does not matter.
BROADSIDE_HD constexpr bool is_better(float value, std::uint32_t key, float best, std::uint32_t best_key) {
  return value > best || (value == best && key < best_key);
}

// Picks up to four of the candidates that for_each gives, with a gap of at most reach_m: the deepest, the one farthest
// from it, the one that makes the largest triangle with both, and the one farthest outside that triangle. Distances are
// those across the normal. The result does not depend on the order of the candidates.
//
// tilt: how far round bodies may turn within a step, rad; 0 = all candidates count alike. One that only a larger turn
// about the deepest point brings down counts for less in the same measure. Before, the four of a bunny on the floor
// were far apart and high up, and between them it rolled into the floor by 7 cm.
template <typename ForEach>
BROADSIDE_HD void keep_four_of(Manifold& out, float reach_m, float tilt, const ForEach& for_each) {
  out.count = 0;
  ManifoldPoint kept[kManifoldPoints];
  const Vec3 n = out.normal;
  for (int round = 0; round < kManifoldPoints; ++round) {
    float best = 0.0F;
    std::uint32_t best_key = 0;
    bool found = false;
    ManifoldPoint chosen;
    for_each([&](const ManifoldPoint& candidate) {
      if (!(candidate.gap_m <= reach_m)) return;
      // One corner may come with several triangles; where the common area is a line but for rounding, one edge may
      // cross one side twice.
      bool is_kept = false;
      for (int earlier = 0; earlier < round; ++earlier) is_kept |= kept[earlier].feature == candidate.feature;
      if (is_kept) return;
      const Vec3 from_first = candidate.point - kept[0].point;
      const Vec3 across = from_first - dot(n, from_first) * n;
      float value = 0.0F;
      if (round == 0) {
        value = -candidate.gap_m;
      } else if (round == 1) {
        value = dot(across, across);
      } else if (round == 2) {
        value = fabsf(dot(n, cross(kept[1].point - kept[0].point, from_first)));
      } else {
        const float twice = dot(n, cross(kept[1].point - kept[0].point, kept[2].point - kept[0].point));
        const float turn = twice < 0.0F ? -1.0F : 1.0F;
        for (int side = 0; side < 3; ++side) {
          const Vec3 start = kept[side].point;
          const Vec3 end = kept[side == 2 ? 0 : side + 1].point;
          value = fmaxf(value, -turn * dot(n, cross(end - start, candidate.point - start)));
        }
      }
      if (round > 0 && tilt > 0.0F) {
        const float rise = candidate.gap_m - kept[0].gap_m;
        const float reached = tilt * length(across);
        if (rise > reached) value = value * ((reached / rise) * (reached / rise));
      }
      if (round > 0 && !(value > 0.0F)) return;
      if (found && !is_better(value, candidate.feature, best, best_key)) return;
      found = true;
      best = value;
      best_key = candidate.feature;
      chosen = candidate;
    });
    if (!found) break;
    kept[round] = chosen;
    out.count = round + 1;
  }
  // In the order of their keys: the same while the same four are kept.
  for (int k = 0; k < out.count; ++k) {
    int place = k;
    for (; place > 0 && kept[k].feature < out.points[place - 1].feature; --place)
      out.points[place] = out.points[place - 1];
    out.points[place] = kept[k];
  }
}

// Bodies that fall onto each other at 10 m/s turn by so much within a step, rad.
inline constexpr float kTurnOfStep = 0.125F;

template <typename At>
BROADSIDE_HD void keep_four(Manifold& out, int count, float reach_m, const At& at) {
  keep_four_of(out, reach_m, 0.0F, [&](const auto& consider) {
    for (int k = 0; k < count; ++k) consider(at(k));
  });
}

BROADSIDE_HD void keep_one(Manifold& out, Vec3 point, float gap_m, std::uint32_t feature) {
  out.count = 1;
  out.points[0] = {point, gap_m, feature};
}

BROADSIDE_HD void turn_over(Manifold& manifold) {
  manifold.normal = -manifold.normal;
}

}  // namespace broadside::core
