// The body octrees of turned bodies against each other, RIGID 8.3: nodes are boxes in body axes, tested by separating
// axes at the levels of core/method/levels.hpp.
//
// Rounding never separates boxes that overlap, nor parents whose children it does not separate, because each level is
// grown by a slack of its own. So A, B and C agree bit for bit, and every pair that they confirm passes level1 and
// flat.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/levels.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

// How B lies in A's axes: what every pair of nodes of the two bodies shares.
struct RelativePose {
  Vec3 between;          // from A's center of mass to B's, in A's axes, m
  TurnedAxes turn;       // B's axes in A's
  float grow_m = 0.0F;   // how far the two may come together
  float slack_m = 0.0F;  // more than rounding moves a gap by
};

// Roundings of a gap along any of the 15 axes, in units of 2^-24 of the lengths from which it is computed. Going from
// quaternions to axes takes 12, the products of axes 24 in each of two turns, the sums 6, and all of that counts twice
// where an axis is a cross product: below 128. A slack is two such errors, 256: then a level that is grown by one slack
// more than the next one separates nothing that the next one does not separate.
inline constexpr float kGapRoundings = 256.0F;

// Nodes are boxes relative to the center of mass. size_a_m, size_b_m: no corner of a node is farther from the center of
// mass.
BROADSIDE_HD RelativePose relative_pose(const ContactPose& a, float size_a_m, const ContactPose& b, float size_b_m,
                                        float grow_m) {
  const TurnedAxes axes_a = turned_axes(a.q);
  const TurnedAxes axes_b = turned_axes(b.q);
  RelativePose p;
  const Vec3 d = b.x - a.x;
  p.between = turned_back(axes_a, d);
  p.turn = {turned_back(axes_a, axes_b.x), turned_back(axes_a, axes_b.y), turned_back(axes_a, axes_b.z)};
  p.grow_m = grow_m;
  p.slack_m = kGapRoundings * 0x1p-24F * (((fabsf(d.x) + fabsf(d.y)) + fabsf(d.z)) + (size_a_m + size_b_m) + grow_m);
  return p;
}

// Whether two nodes, boxes from the centers of mass in body axes, are apart along one of the 15 axes.
BROADSIDE_HD bool are_apart(const Box& a, const Box& b, const RelativePose& p, float grow_m) {
  const Vec3 ha = 0.5F * (a.max - a.min);
  const Vec3 hb = 0.5F * (b.max - b.min);
  const Vec3 t = (p.between + turned(p.turn, center(b))) - center(a);
  float m[3][3];  // m[i][j]: |A's axis i along B's axis j|
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = fabsf(p.turn[j][i]);
  for (int i = 0; i < 3; ++i) {
    const float rb = (m[i][0] * hb.x + m[i][1] * hb.y) + m[i][2] * hb.z;
    if (fabsf(t[i]) > (ha[i] + rb) + grow_m) return true;
  }
  for (int j = 0; j < 3; ++j) {
    const float ra = (m[0][j] * ha.x + m[1][j] * ha.y) + m[2][j] * ha.z;
    if (fabsf(dot(t, p.turn[j])) > (ra + hb[j]) + grow_m) return true;
  }
  // A cross product of two axes is at most 1 long. A shorter one separates less, never more.
  for (int i = 0; i < 3; ++i) {
    const int i1 = i == 2 ? 0 : i + 1;
    const int i2 = i == 0 ? 2 : i - 1;
    for (int j = 0; j < 3; ++j) {
      const int j1 = j == 2 ? 0 : j + 1;
      const int j2 = j == 0 ? 2 : j - 1;
      const float ra = ha[i1] * m[i2][j] + ha[i2] * m[i1][j];
      const float rb = hb[j1] * m[i][j2] + hb[j2] * m[i][j1];
      if (fabsf(t[i2] * p.turn[j][i1] - t[i1] * p.turn[j][i2]) > (ra + rb) + grow_m) return true;
    }
  }
  return false;
}

// How much each level is grown: the last one by one slack, each level above by one slack more.
BROADSIDE_HD constexpr float level_grow_m(const RelativePose& p, int level) {
  return p.grow_m + (level == 2 ? 1.0F : (level == 1 ? 2.0F : 3.0F)) * p.slack_m;
}

// The functions below count their tests and stop at the first pair that is not apart, as in core/method/levels.hpp.
template <typename Tests>
BROADSIDE_HD bool oriented_level1_overlaps(const NodeBoxes& a, const NodeBoxes& b, const RelativePose& pose,
                                           Tests& tests) {
  const float grow_m = level_grow_m(pose, 1);
  for (int p = 0; p < a.level1_count; ++p) {
    for (int q = 0; q < b.level1_count; ++q) {
      ++tests;
      if (!are_apart(a.level1[p], b.level1[q], pose, grow_m)) return true;
    }
  }
  return false;
}

template <typename Tests>
BROADSIDE_HD bool oriented_level2_overlaps(const NodeBoxes& a, const NodeBoxes& b, const RelativePose& pose,
                                           Tests& tests) {
  const float grow_m = level_grow_m(pose, 2);
  for (int p = 0; p < a.level2_count; ++p) {
    for (int q = 0; q < b.level2_count; ++q) {
      ++tests;
      if (!are_apart(a.level2[p], b.level2[q], pose, grow_m)) return true;
    }
  }
  return false;
}

template <typename Tests>
BROADSIDE_HD bool oriented_descent_overlaps(const NodeBoxes& a, const NodeBoxes& b, const RelativePose& pose,
                                            Tests& tests) {
  const float grow1_m = level_grow_m(pose, 1);
  const float grow2_m = level_grow_m(pose, 2);
  for (int p = 0; p < a.level1_count; ++p) {
    for (int q = 0; q < b.level1_count; ++q) {
      ++tests;
      if (are_apart(a.level1[p], b.level1[q], pose, grow1_m)) continue;
      for (int r = a.leaf_begin[p]; r < a.leaf_begin[p + 1]; ++r) {
        for (int s = b.leaf_begin[q]; s < b.leaf_begin[q + 1]; ++s) {
          ++tests;
          if (!are_apart(a.level2[r], b.level2[s], pose, grow2_m)) return true;
        }
      }
    }
  }
  return false;
}

// Whether some pair of nodes of this setting's last level overlaps.
template <typename Tests>
BROADSIDE_HD bool is_confirmed(Levels levels, const NodeBoxes& a, const NodeBoxes& b, const RelativePose& pose,
                               Tests& tests) {
  switch (levels) {
    case Levels::kFlat:
      ++tests;
      return !are_apart(a.root, b.root, pose, level_grow_m(pose, 0));
    case Levels::kLevel1:
      return oriented_level1_overlaps(a, b, pose, tests);
    case Levels::kA:
      return oriented_level2_overlaps(a, b, pose, tests);
    case Levels::kB:
      return oriented_descent_overlaps(a, b, pose, tests);
    case Levels::kC:
      ++tests;
      return !are_apart(a.root, b.root, pose, level_grow_m(pose, 0)) && oriented_descent_overlaps(a, b, pose, tests);
  }
  return false;
}

}  // namespace broadside::core
