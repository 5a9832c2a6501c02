// The point of a simplex that is nearest to the origin, and the corners that it is made of.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

struct Simplex {
  int count = 0;
  Vec3 corners[4];
  float weights[4] = {};  // of the corners that were kept: shares of 1
  // Where corners are differences of two bodies' corners: the numbers of these corners.
  std::uint32_t of_a[4] = {};
  std::uint32_t of_b[4] = {};
};

namespace simplex_detail {

struct Weighed {
  int count = 0;
  int corner[3] = {};
  float weight[3] = {};
};

BROADSIDE_HD Weighed on_edge(int p, int q, float share) {
  if (!(share > 0.0F)) return {1, {p}, {1.0F}};
  if (!(share < 1.0F)) return {1, {q}, {1.0F}};
  return {2, {p, q}, {1.0F - share, share}};
}

BROADSIDE_HD Vec3 point_of(const Simplex& s, const Weighed& w) {
  Vec3 x;
  for (int k = 0; k < w.count; ++k) x = x + w.weight[k] * s.corners[w.corner[k]];
  return x;
}

BROADSIDE_HD Weighed nearest_of_edge(const Simplex& s, int p, int q) {
  const Vec3 along = s.corners[q] - s.corners[p];
  const float squared = dot(along, along);
  return on_edge(p, q, squared > 0.0F ? -dot(s.corners[p], along) / squared : 0.0F);
}

// By the regions of corners, edges and the inside (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
BROADSIDE_HD_CALLED Weighed nearest_of_triangle(const Simplex& s, int p, int q, int r) {
  const Vec3 a = s.corners[p];
  const Vec3 b = s.corners[q];
  const Vec3 c = s.corners[r];
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const float ab_a = -dot(ab, a);
  const float ac_a = -dot(ac, a);
  if (ab_a <= 0.0F && ac_a <= 0.0F) return {1, {p}, {1.0F}};
  const float ab_b = -dot(ab, b);
  const float ac_b = -dot(ac, b);
  if (ab_b >= 0.0F && ac_b <= ab_b) return {1, {q}, {1.0F}};
  const float of_c = ab_a * ac_b - ab_b * ac_a;
  if (of_c <= 0.0F && ab_a >= 0.0F && ab_b <= 0.0F) return on_edge(p, q, ab_a / (ab_a - ab_b));
  const float ab_c = -dot(ab, c);
  const float ac_c = -dot(ac, c);
  if (ac_c >= 0.0F && ab_c <= ac_c) return {1, {r}, {1.0F}};
  const float of_b = ab_c * ac_a - ab_a * ac_c;
  if (of_b <= 0.0F && ac_a >= 0.0F && ac_c <= 0.0F) return on_edge(p, r, ac_a / (ac_a - ac_c));
  const float of_a = ab_b * ac_c - ab_c * ac_b;
  const float to_c = ac_b - ab_b;
  const float to_b = ab_c - ac_c;
  if (of_a <= 0.0F && to_c >= 0.0F && to_b >= 0.0F) return on_edge(q, r, to_c / (to_c + to_b));
  const float sum = of_a + of_b + of_c;
  if (!(sum > 0.0F)) return {1, {p}, {1.0F}};
  return {3, {p, q, r}, {of_a / sum, of_b / sum, of_c / sum}};
}

}  // namespace simplex_detail

// Keeps the corners that the nearest point needs, and returns that point. inside_m: 0, unless four corners surround the
// origin: then it is the distance of the nearest side, and all corners are kept, with weights that add up to 1 to
// within rounding.
BROADSIDE_HD Vec3 keep_nearest(Simplex& s, float& inside_m) {
  using namespace simplex_detail;
  inside_m = 0.0F;
  Weighed best{1, {0}, {1.0F}};
  if (s.count == 2) best = nearest_of_edge(s, 0, 1);
  if (s.count == 3) best = nearest_of_triangle(s, 0, 1, 2);
  if (s.count == 4) {
    float least = 3.402823e38F;
    float nearest_side = 3.402823e38F;
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < 4; ++k) {
      // The side opposite corner k.
      const int p = k == 0 ? 1 : 0;
      const int q = k <= 1 ? 2 : 1;
      const int r = k <= 2 ? 3 : 2;
      const Vec3 n = cross(s.corners[q] - s.corners[p], s.corners[r] - s.corners[p]);
      const float of_origin = -dot(n, s.corners[p]);
      const float of_corner = dot(n, s.corners[k] - s.corners[p]);
      if (of_origin * of_corner > 0.0F) {
        nearest_side = fminf(nearest_side, fabsf(of_origin) / length(n));
        s.weights[k] = of_origin / of_corner;
        continue;
      }
      const Weighed own = nearest_of_triangle(s, p, q, r);
      const Vec3 x = point_of(s, own);
      if (!(dot(x, x) < least)) continue;
      least = dot(x, x);
      best = own;
    }
    if (!(least < 3.0e38F)) {
      inside_m = nearest_side;
      return {};
    }
  }
  const Vec3 x = point_of(s, best);
  Simplex kept;
  kept.count = best.count;
  for (int k = 0; k < best.count; ++k) {
    kept.corners[k] = s.corners[best.corner[k]];
    kept.weights[k] = best.weight[k];
    kept.of_a[k] = s.of_a[best.corner[k]];
    kept.of_b[k] = s.of_b[best.corner[k]];
  }
  s = kept;
  return x;
}

}  // namespace broadside::core
