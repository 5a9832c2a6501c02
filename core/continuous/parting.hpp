// Directions that separate two moving features, and for how long: one of them proves each step of a search for the
// first touch. For one query, or several side by side (lane_math.hpp).
#pragma once

#include "core/continuous/lane_math.hpp"
#include "core/continuous/moving_features.hpp"

namespace broadside::continuous {

// Differences of each point of the first feature and each point of the second. kCount is 3 for a vertex and a triangle,
// and 4 for two edges (in the order 0-2, 0-3, 1-2, 1-3 of MovingFeatures).
template <typename Real, int kCount>
struct Differences {
  Triple<Real> start[kCount];
  Triple<Real> end[kCount];
  Triple<Real> reach[kCount];  // the larger magnitude of start and end, axis by axis
  Triple<Real> most;           // the largest of all of them
};

inline constexpr int kFaceCount = 3;
inline constexpr int kEdgeCount = 4;

// A difference of coordinates, a product and two sums: four roundings of 2^-53 each, and one more for the bound itself.
inline constexpr double kRounding = 5.0 * 0x1p-53;
// Covers products that fall below the smallest normal double.
inline constexpr double kUnderflow = 0x1p-1060;
// A line's zero takes three roundings, of 2^-53 each.
inline constexpr double kZeroRounding = 0x1p-51;

// points: as MovingFeatures numbers them.
template <int kCount, typename Real>
BROADSIDE_HD Differences<Real, kCount> differences(const Triple<Real> (&start)[4], const Triple<Real> (&end)[4]) {
  Differences<Real, kCount> out;
  for (int k = 0; k < kCount; ++k) {
    const int i = kCount == kFaceCount ? 0 : k / 2;
    const int j = kCount == kFaceCount ? k + 1 : 2 + k % 2;
    out.start[k] = start[i] - start[j];
    out.end[k] = end[i] - end[j];
    out.reach[k] = larger(magnitude(out.start[k]), magnitude(out.end[k]));
    out.most = k == 0 ? out.reach[0] : larger(out.most, out.reach[k]);
  }
  return out;
}

// The time, from `time` on, up to which d certainly separates the features: above 1 for the whole rest of the step, and
// at most `time` when d proves nothing. Along a fixed d the differences are linear in time. d need not be a unit
// vector.
template <typename Real, int kCount>
BROADSIDE_HD Real parted_until(const Differences<Real, kCount>& x, const Triple<Real>& d, const Real& time) {
  const Real doubt = kRounding * dot(magnitude(d), x.most) + Real(kUnderflow);
  Real until(2.0);
  auto is_vain = time < Real(0.0);
  for (int k = 0; k < kCount; ++k) {
    const Real first = dot(d, x.start[k]) - doubt;
    const Real last = dot(d, x.end[k]) - doubt;
    const Real fall = first - last;
    const auto begins = first > Real(0.0);
    const auto ends = last > Real(0.0);
    const auto falls = begins & !ends;
    const Real zero = pick(falls, first, Real(2.0)) / pick(falls, fall, Real(1.0));
    until = lesser(until, zero * Real(1.0 - kZeroRounding));
    const auto has_risen = time * fall < first * Real(1.0 + kZeroRounding);
    is_vain = is_vain | !(begins | (ends & has_risen));
  }
  return pick(is_vain, time, until);
}

template <typename Real, int kCount>
BROADSIDE_HD void places_at(const Differences<Real, kCount>& x, const Real& time, Triple<Real> (&now)[kCount]) {
  for (int k = 0; k < kCount; ++k) now[k] = x.start[k] + time * (x.end[k] - x.start[k]);
}

template <typename Real>
BROADSIDE_HD Triple<Real> towards(const Triple<Real>& normal, const Triple<Real>& side) {
  return pick(dot(normal, side) < Real(0.0), Real(-1.0) * normal, normal);
}

// The normal of the triangle, or the common normal of both edges, toward the first feature. Not a unit vector.
template <typename Real>
BROADSIDE_HD Triple<Real> across(const Triple<Real> (&now)[kFaceCount]) {
  return towards(cross(now[1] - now[0], now[2] - now[0]), now[0]);
}
template <typename Real>
BROADSIDE_HD Triple<Real> across(const Triple<Real> (&now)[kEdgeCount]) {
  return towards(cross(now[2] - now[0], now[0] - now[1]), now[0]);
}

// The direction from the nearest point of the triangle to the vertex, chosen by the region in which the vertex lies: a
// corner, an edge, or the inside. Inside it is the triangle's normal, which keeps digits that a difference would lose.
// Not a unit vector.
template <typename Real>
BROADSIDE_HD Triple<Real> nearest(const Triple<Real> (&now)[kFaceCount]) {
  const Real zero(0.0), one(1.0);
  const Triple<Real>&a = now[0], &b = now[1], &c = now[2];
  const Triple<Real> u = b - a;
  const Triple<Real> v = c - a;
  const Real ua = zero - dot(u, a), va = zero - dot(v, a);
  const Real ub = zero - dot(u, b), vb = zero - dot(v, b);
  const Real uc = zero - dot(u, c), vc = zero - dot(v, c);
  const Real area_c = ua * vb - ub * va, area_b = uc * va - ua * vc, area_a = ub * vc - uc * vb;
  const Real from_b = vb - ub, from_c = uc - vc;
  const auto at_a = (ua <= zero) & (va <= zero);
  const auto at_b = (ub >= zero) & (vb <= ub);
  const auto at_c = (vc >= zero) & (uc <= vc);
  const auto on_ab = (area_c <= zero) & (ua >= zero) & (ub <= zero) & (ua > ub);
  const auto on_ac = (area_b <= zero) & (va >= zero) & (vc <= zero) & (va > vc);
  const auto on_bc = (area_a <= zero) & (from_b >= zero) & (from_c >= zero) & (from_b + from_c > zero);
  // A point of an edge is base + (part / whole) way. The first region that holds counts, so it is picked last.
  Triple<Real> base = b, way = c - b;
  Real part = from_b, whole = from_b + from_c;
  const auto take = [&](const auto& is_it, const Triple<Real>& at, const Triple<Real>& along, const Real& p,
                        const Real& w) {
    base = pick(is_it, at, base);
    way = pick(is_it, along, way);
    part = pick(is_it, p, part);
    whole = pick(is_it, w, whole);
  };
  take(on_ac, a, v, va, va - vc);
  take(at_c, c, v, zero, one);
  take(on_ab, a, u, ua, ua - ub);
  take(at_b, b, u, zero, one);
  take(at_a, a, u, zero, one);
  const auto is_inside = !(at_a | at_b | at_c | on_ab | on_ac | on_bc);
  const Triple<Real> edge = base + (part / pick(is_inside, one, whole)) * way;
  const Triple<Real> normal = across(now);
  const auto has_area = dot(normal, normal) > zero;
  return pick(is_inside, pick(has_area, normal, a), edge);
}

// The difference of the nearest points of two edges, or where both lie inside their edges, the common normal. Not a
// unit vector.
template <typename Real>
BROADSIDE_HD Triple<Real> nearest(const Triple<Real> (&now)[kEdgeCount]) {
  const Real zero(0.0), one(1.0);
  const Triple<Real> u = now[2] - now[0];
  const Triple<Real> v = now[0] - now[1];
  const Triple<Real>& w = now[0];
  const Real uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const Real determinant = uu * vv - uv * uv;
  const auto is_skew = determinant > zero;
  const auto has_u = uu > zero;
  const auto has_v = vv > zero;
  const Real whole_u = pick(has_u, uu, one);
  const Real s = pick(is_skew, within_unit((uv * vw - vv * uw) / pick(is_skew, determinant, one)), zero);
  const Real r = (uv * s + vw) / pick(has_v, vv, one);
  const Real r_within = pick(has_v, within_unit(r), zero);
  const auto is_outside = (r < zero) | (r > one) | !has_v;
  const Real s_again = pick(has_u, within_unit((uv * r_within - uw) / whole_u), zero);
  const Triple<Real> edge = (w + pick(is_outside, s_again, s) * u) - r_within * v;
  const Triple<Real> normal = across(now);
  const auto is_inside = is_skew & (s > zero) & (s < one) & (r > zero) & (r < one) & (dot(normal, normal) > zero);
  return pick(is_inside, normal, edge);
}

// True when all differences have one sign along an axis. Rounding never changes the sign of a difference, so this is
// exact.
template <typename Real, int kCount>
BROADSIDE_HD auto is_apart_along_an_axis(const Differences<Real, kCount>& x) {
  Triple<Real> least = lesser(x.start[0], x.end[0]);
  Triple<Real> most = larger(x.start[0], x.end[0]);
  for (int k = 1; k < kCount; ++k) {
    least = lesser(least, lesser(x.start[k], x.end[k]));
    most = larger(most, larger(x.start[k], x.end[k]));
  }
  const Real zero(0.0);
  // | instead of ||, to avoid a branch.
  // NOLINTNEXTLINE(clang-diagnostic-bitwise-instead-of-logical)
  return (larger(larger(least.x, least.y), least.z) > zero) | (lesser(lesser(most.x, most.y), most.z) < zero);
}

// A direction that is likely to separate them for the whole step. For a vertex and a triangle it goes from the mean
// position of the corners to that of the vertex, which works nearly as well as the nearest point and costs a quarter;
// for edges it is the nearest direction at half time.
template <typename Real>
BROADSIDE_HD Triple<Real> middle_direction(const Differences<Real, kFaceCount>& x) {
  return (x.start[0] + x.end[0]) + (x.start[1] + x.end[1]) + (x.start[2] + x.end[2]);
}
template <typename Real>
BROADSIDE_HD Triple<Real> middle_direction(const Differences<Real, kEdgeCount>& x) {
  Triple<Real> now[kEdgeCount];
  places_at(x, Real(0.5), now);
  return nearest(now);
}

}  // namespace broadside::continuous
