// The direction along which two shapes are farthest apart, or overlap least.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

// kPoints: the direction between two points; one of them is a corner, the other a corner or a point of an edge.
enum class AxisKind { kNone, kFaceOfA, kFaceOfB, kEdges, kPoints };

struct SeparatingAxis {
  float gap_m = -3.402823e38F;  // along the normal; negative = overlap
  Vec3 normal;                  // unit, from B to A
  AxisKind kind = AxisKind::kNone;
  int of_a = 0;  // the face or edge
  int of_b = 0;
  bool has_faces = false;  // face_of_a and face_of_b are the faces that look along it most
  int face_of_a = 0;
  int face_of_b = 0;
  bool has_ends = false;  // ends_of_a and ends_of_b are the corners of both edges, which then have no numbers
  int ends_of_a[2] = {};
  int ends_of_b[2] = {};
};

// Pairs of edges at less than this angle (16 roundings) are left out, because their cross product consists of rounding.
// If a direction across two parallel edges separates the bodies, the normal of a face does, too. So with edges that are
// parallel to within this angle a gap is off by at most 16 roundings of the size of the bodies.
inline constexpr float kParallelSine = 16.0F * 0x1p-24F;

// Of two boxes: all fifteen axes (Gottschalk, Lin and Manocha, OBBTree, 1996). Unlike there, each gap is taken along
// the direction that was computed, with the reach of both boxes along it, so every one of them is a true lower bound of
// the distance and edges that are nearly parallel need no allowance. A later axis is taken where it is wider by more
// than rounding: faces of A before faces of B before edges.
BROADSIDE_HD_CALLED SeparatingAxis separating_axis_of_boxes(const PlacedShape& a, const PlacedShape& b,
                                                            float rounding_m, float reach_m) {
  const Vec3 ha = a.shape->half;
  const Vec3 hb = b.shape->half;
  const Vec3 d = a.center - b.center;
  float along[3][3];  // axis i of A on axis j of B
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) along[i][j] = dot(a.axes[i], b.axes[j]);
  SeparatingAxis best;
  for (int i = 0; i < 3; ++i) {
    const float reach_of_b = fabsf(along[i][0]) * hb.x + fabsf(along[i][1]) * hb.y + fabsf(along[i][2]) * hb.z;
    const float t = dot(d, a.axes[i]);
    const float gap = fabsf(t) - (ha[i] + reach_of_b);
    // A's face looks at B: along -axis where A is on the upper side.
    const bool lower = t > 0.0F;
    if (gap > best.gap_m) best = {gap, lower ? a.axes[i] : -a.axes[i], AxisKind::kFaceOfA, 2 * i + (lower ? 0 : 1), 0};
  }
  if (best.gap_m > reach_m) return best;
  SeparatingAxis other;
  for (int j = 0; j < 3; ++j) {
    const float reach_of_a = fabsf(along[0][j]) * ha.x + fabsf(along[1][j]) * ha.y + fabsf(along[2][j]) * ha.z;
    const float t = dot(d, b.axes[j]);
    const float gap = fabsf(t) - (hb[j] + reach_of_a);
    const bool upper = t > 0.0F;
    if (gap > other.gap_m)
      other = {gap, upper ? b.axes[j] : -b.axes[j], AxisKind::kFaceOfB, 0, 2 * j + (upper ? 1 : 0)};
  }
  if (other.gap_m > best.gap_m + rounding_m) best = other;
  if (best.gap_m > reach_m) return best;
  // Edge axes are first rated by the components of their cross products in the axes of the boxes; these are the cosines
  // that are known already. Only axes whose gap may exceed that of the best face by more than rounding are computed. A
  // cosine is off by twelve roundings, and the two lengths that it multiplies are among those that rounding_m is made
  // of: together 17 of its 32 roundings.
  const Vec3 apart = turned_back(a.axes, d);
  const float least_m = best.gap_m + rounding_m;
  const float slack_m = 0.75F * rounding_m;
  unsigned may_be_wider = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = i == 2 ? 0 : i + 1;
      const int i2 = i == 0 ? 2 : i - 1;
      const int j1 = j == 2 ? 0 : j + 1;
      const int j2 = j == 0 ? 2 : j - 1;
      const float reach_m2 = (ha[i1] * fabsf(along[i2][j]) + ha[i2] * fabsf(along[i1][j])) +
                             (hb[j1] * fabsf(along[i][j2]) + hb[j2] * fabsf(along[i][j1]));
      const float sine = sqrtf(along[i1][j] * along[i1][j] + along[i2][j] * along[i2][j]);
      const float gap_m = fabsf(apart[i2] * along[i1][j] - apart[i1] * along[i2][j]) - reach_m2;
      if (gap_m + slack_m > least_m * sine) may_be_wider |= 1U << (3 * i + j);
    }
  other = {};
  BROADSIDE_KEPT_LOOP
  for (int pair = 0; pair < 9; ++pair) {
    if ((may_be_wider >> pair & 1U) == 0) continue;
    const int i = pair / 3;
    const int j = pair % 3;
    const Vec3 across = cross(a.axes[i], b.axes[j]);
    const float squared = dot(across, across);
    if (!(squared > kParallelSine * kParallelSine)) continue;
    const Vec3 n = (1.0F / sqrtf(squared)) * across;
    const float reach_of_a =
        fabsf(dot(a.axes.x, n)) * ha.x + fabsf(dot(a.axes.y, n)) * ha.y + fabsf(dot(a.axes.z, n)) * ha.z;
    const float reach_of_b =
        fabsf(dot(b.axes.x, n)) * hb.x + fabsf(dot(b.axes.y, n)) * hb.y + fabsf(dot(b.axes.z, n)) * hb.z;
    const float t = dot(d, n);
    const float gap = fabsf(t) - (reach_of_a + reach_of_b);
    if (gap > other.gap_m) other = {gap, t > 0.0F ? n : -n, AxisKind::kEdges, i, j};
  }
  if (!(other.gap_m > best.gap_m + rounding_m)) return best;
  // The edge of A is on the side of A that faces B, and the other way round. Numbers as in BoxPolytope.
  const int i = other.of_a;
  const int j = other.of_b;
  other.of_a = 4 * i;
  other.of_b = 4 * j;
  for (int k = 0, bit = 1; k < 3; ++k) {
    if (k == i) continue;
    if (dot(a.axes[k], other.normal) < 0.0F) other.of_a += bit;
    bit *= 2;
  }
  for (int k = 0, bit = 1; k < 3; ++k) {
    if (k == j) continue;
    if (dot(b.axes[k], other.normal) > 0.0F) other.of_b += bit;
    bit *= 2;
  }
  return other;
}

}  // namespace broadside::core
