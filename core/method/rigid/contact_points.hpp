// Candidates for the points of one manifold, and the four that are kept.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/corner_layer.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/lanes.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// For bodies that are apart by axis_gap_m along an axis, and whose nearest points, distance_m apart, lie beside the
// faces that are over each other: whether points of these faces, whose least gap is least_m, can stand for the nearest
// points. A patch of the nearest point alone would let the bodies tilt down on each side of it. Before, a brick that
// fell on another one at 9 m/s, tilted by a degree and 5 mm to the side, was held at one corner and ended 9 cm deep.
BROADSIDE_HD constexpr bool is_nearly_shown(float axis_gap_m, float least_m, float distance_m) {
  constexpr float kShare = 0x1p-4F;
  return axis_gap_m >= (1.0F - kShare) * distance_m && least_m <= (1.0F + kShare) * distance_m;
}

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

// Picks up to four of the candidates that for_each gives, with a gap of at most reach_m: the deepest, the one farthest
// from it, the one that makes the largest triangle with both, and the one farthest outside that triangle. Distances are
// those across the normal. The result does not depend on the order of the candidates.
//
// tilt: by how much round bodies turn within a step, rad; 0 = areas decide, as above. Otherwise the deepest candidate
// is kept, and then the one that such a turn would bring farthest below the height at which the kept points hold the
// body (brought_down). Three simpler rules failed. When all candidates counted alike, the four points of a bunny on the
// floor were far apart and high up, and between them it rolled 7 cm into the floor. When all candidates that a turn of
// the step brings down counted alike, a card that landed flat kept a corner of its upper side, which was slightly
// farther out, in place of the corner below it that stood on the floor, and rolled over that one. When areas decided,
// with less weight for points high above the deepest one, a corner that a bunny stood on was left out because it lay
// between others that were 1 to 4 cm over the floor, and the bunny rolled 13 mm into the floor.
//
// apart_m: candidates of many small faces may lie on one line. If this is not 0, the third and fourth point are those
// farthest from the segment and from the triangle of those before, and a point that is not farther than this is left
// out. With areas alone, points a little beside a line are preferred to its far end: a cylinder that lay on a floor of
// triangles kept its deepest point, which rounding chose, one end of its line, and two points between both. So only
// half of its line was supported.
class FourKept {
 public:
  BROADSIDE_HD FourKept(Vec3 normal, float reach_m, float tilt, float apart_m = 0.0F)
      : n_(normal), reach_m_(reach_m), tilt_(tilt), apart_m_(apart_m) {}

  // The candidate's score in the next round.
  [[nodiscard]] BROADSIDE_HD_CALLED Rated rate(const ManifoldPoint& candidate) const {
    Rated rated;
    if (!(candidate.gap_m <= reach_m_)) return rated;
    // A corner may come with several triangles; and where the common area is a line to within rounding, an edge may
    // cross a side twice.
    bool is_kept = false;
    for (int earlier = 0; earlier < count_; ++earlier) is_kept |= kept_[earlier].feature == candidate.feature;
    if (is_kept) return rated;
    const Vec3 from_first = candidate.point - kept_[0].point;
    float value = 0.0F;
    if (count_ == 0) {
      value = -candidate.gap_m;
    } else if (tilt_ > 0.0F) {
      value = brought_down(candidate);
    } else if (count_ == 1) {
      const Vec3 beside = across(from_first);
      value = dot(beside, beside);
    } else if (count_ == 2) {
      value = fabsf(dot(n_, cross(kept_[1].point - kept_[0].point, from_first)));
      if (apart_m_ > 0.0F) value = beyond(squared_to_side(candidate.point, 0, 1));
    } else {
      const float twice = dot(n_, cross(kept_[1].point - kept_[0].point, kept_[2].point - kept_[0].point));
      const float turn = twice < 0.0F ? -1.0F : 1.0F;
      for (int side = 0; side < 3; ++side) {
        const Vec3 start = kept_[side].point;
        const Vec3 end = kept_[side == 2 ? 0 : side + 1].point;
        value = fmaxf(value, -turn * dot(n_, cross(end - start, candidate.point - start)));
      }
      if (apart_m_ > 0.0F && value > 0.0F)
        value = beyond(fminf(squared_to_side(candidate.point, 0, 1),
                             fminf(squared_to_side(candidate.point, 1, 2), squared_to_side(candidate.point, 2, 0))));
    }
    return {count_ == 0 || value > 0.0F, value, candidate.feature};
  }

  BROADSIDE_HD void keep(const ManifoldPoint& chosen) { kept_[count_++] = chosen; }

  // In the order of their keys, so the order stays while the same four points are kept.
  BROADSIDE_HD void tell(Manifold& out) const {
    out.count = count_;
    for (int k = 0; k < count_; ++k) {
      int place = k;
      for (; place > 0 && kept_[k].feature < out.points[place - 1].feature; --place)
        out.points[place] = out.points[place - 1];
      out.points[place] = kept_[k];
    }
  }

 private:
  [[nodiscard]] BROADSIDE_HD Vec3 across(Vec3 d) const { return d - dot(n_, d) * n_; }

  // By how much a turn brings the candidate below what holds the body, m: the kept point, segment or triangle, at its
  // place nearest to the candidate. Where the candidate is higher than that, a positive value, which is smaller the
  // larger the height is against the turn.
  [[nodiscard]] BROADSIDE_HD_CALLED float brought_down(const ManifoldPoint& candidate) const {
    const Vec3 from_first = across(candidate.point - kept_[0].point);
    float squared = dot(from_first, from_first);
    float held_m = kept_[0].gap_m;
    const int sides = count_ == 3 ? 3 : count_ - 1;
    for (int side = 0; side < sides; ++side) {
      const ManifoldPoint& start = kept_[side];
      const ManifoldPoint& end = kept_[side == 2 ? 0 : side + 1];
      const Vec3 way = across(end.point - start.point);
      const Vec3 d = across(candidate.point - start.point);
      const float share = share_nearest(d, {}, way);
      const Vec3 between = d - share * way;
      const float own = dot(between, between);
      if (!(own < squared)) continue;
      squared = own;
      held_m = start.gap_m + share * (end.gap_m - start.gap_m);
    }
    if (count_ == 3 && held_inside(candidate.point, held_m)) squared = 0.0F;
    const float turned_m = tilt_ * sqrtf(squared);
    const float rise_m = candidate.gap_m - held_m;
    if (!(rise_m > 0.0F)) return turned_m - rise_m;
    const float share = turned_m / (turned_m + rise_m);
    return turned_m * (share * share);
  }

  // Whether x is over the triangle of the three kept points. If so, held_m is the gap of their plane there.
  [[nodiscard]] BROADSIDE_HD bool held_inside(Vec3 x, float& held_m) const {
    float whole = 0.0F;
    float sum_m = 0.0F;
    const Vec3 first = kept_[0].point;
    const float turn = dot(n_, cross(kept_[1].point - first, kept_[2].point - first)) < 0.0F ? -1.0F : 1.0F;
    for (int k = 0; k < 3; ++k) {
      const Vec3 start = kept_[k == 2 ? 0 : k + 1].point;
      const Vec3 end = kept_[k == 0 ? 2 : k - 1].point;
      const float part = turn * dot(n_, cross(end - start, x - start));
      if (!(part > 0.0F)) return false;
      whole = whole + part;
      sum_m = sum_m + part * kept_[k].gap_m;
    }
    held_m = sum_m / whole;
    return true;
  }

  // The squared distance across the normal from the segment between two kept points.
  [[nodiscard]] BROADSIDE_HD float squared_to_side(Vec3 x, int from, int to) const {
    const Vec3 side = across(kept_[to].point - kept_[from].point);
    const Vec3 d = across(x - kept_[from].point);
    const Vec3 between = d - share_nearest(d, {}, side) * side;
    return dot(between, between);
  }
  [[nodiscard]] BROADSIDE_HD float beyond(float squared) const {
    return squared > apart_m_ * apart_m_ ? squared : 0.0F;
  }

  Vec3 n_;
  float reach_m_;
  float tilt_;
  float apart_m_;
  int count_ = 0;
  ManifoldPoint kept_[kManifoldPoints];
};

template <typename ForEach>
BROADSIDE_HD void keep_four_of(Manifold& out, float reach_m, float tilt, const ForEach& for_each) {
  FourKept four(out.normal, reach_m, tilt);
  for (int round = 0; round < kManifoldPoints; ++round) {
    Rated best;
    ManifoldPoint chosen;
    for_each([&](const ManifoldPoint& candidate) {
      const Rated own = four.rate(candidate);
      if (!own.counts || (best.counts && !is_better(own.value, own.key, best.value, best.key))) return;
      best = own;
      chosen = candidate;
    });
    if (!best.counts) break;
    four.keep(chosen);
  }
  four.tell(out);
}

// The same for numbered candidates: at(k) gives number k. Only those with has(k) count.
template <typename Lanes, typename At, typename Has>
BROADSIDE_HD void keep_four_by(Manifold& out, int count, float reach_m, float tilt, const At& at, const Has& has,
                               float apart_m = 0.0F) {
  FourKept four(out.normal, reach_m, tilt, apart_m);
  BROADSIDE_KEPT_LOOP
  for (int round = 0; round < kManifoldPoints; ++round) {
    const int best = Lanes::first_best(count, [&](int k) { return has(k) ? four.rate(at(k)) : Rated{}; });
    if (best < 0) break;
    four.keep(at(best));
  }
  four.tell(out);
}

// The same for candidates of which few are near: make(k) gives number k, whose gap is gap(k). If there may be more near
// ones than a Handful holds, they are made anew in each round.
template <typename Lanes, typename Gap, typename Make>
BROADSIDE_HD void keep_four_near(Manifold& out, int count, float reach_m, float tilt, const Gap& gap,
                                 const Make& make) {
  constexpr int kMostNear = 32;
  typename Lanes::template Handful<ManifoldPoint> near;
  (void)near.fill_with(
      0, count, [&](int k) { return gap(k) <= reach_m; }, make);
  if (near.count == kMostNear)
    return keep_four_by<Lanes>(out, count, reach_m, tilt, make, [&](int k) { return gap(k) <= reach_m; });
  FourKept four(out.normal, reach_m, tilt);
  BROADSIDE_KEPT_LOOP
  for (int round = 0; round < kManifoldPoints; ++round) {
    const int best = near.first_best([&](const ManifoldPoint& p) { return four.rate(p); });
    if (best < 0) break;
    four.keep(near.at(best));
  }
  four.tell(out);
}

// A turn of 2 rad/s within a step of 60 Hz, rad; chosen by depths of heaps. With an eighth, the turn of bodies that
// fall onto each other at 10 m/s, points far out and high up count more: 1000 bunnies, 100 frames, are 6.1 mm deep in
// the floor, and not 3.9.
inline constexpr float kTurnOfStep = 0x1p-5F;

template <typename At>
BROADSIDE_HD void keep_four(Manifold& out, int count, float reach_m, const At& at) {
  keep_four_by<OneLane>(out, count, reach_m, 0.0F, at, [](int) { return true; });
}

BROADSIDE_HD void keep_one(Manifold& out, Vec3 point, float gap_m, std::uint32_t feature) {
  out.count = 1;
  out.points[0] = {point, gap_m, feature};
}

BROADSIDE_HD void turn_over(Manifold& manifold) {
  manifold.normal = -manifold.normal;
}

}  // namespace broadside::core
