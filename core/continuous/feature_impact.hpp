// When two moving features first touch, in double: never late, and early by no more than rounding asks for. For host
// and device; the same bits on both.
//
// A direction d parts the features during every time at which d points from each point of the second to each point of
// the first. With d fixed these differences are linear in time, so the time at which the first of them is used up
// follows in closed form, and no touch lies before it. The next direction is that between the nearest points at that
// time. Every step is certified by itself: rounding is subtracted from the differences, and a poor direction costs a
// step, never a touch. Where features turn, a fixed direction is used up long before they meet; so later directions
// turn too, as the last two nearest ones did, and near a plain impact the steps shrink as those of the secant method.
#pragma once

#include <cmath>

#include "core/continuous/moving_features.hpp"

namespace broadside::continuous {

// time: not later than the exact first touch, in units of the step. Without touch it is 1.
struct Impact {
  bool touches = false;
  double time = 1.0;

  friend constexpr bool operator==(const Impact&, const Impact&) = default;
};

// Steps that a query may take. Plain impacts take three to ten; one that is not through by then is reported as a touch
// at the time reached, which is early.
inline constexpr int kMostSteps = 64;
// After so many steps the direction turns as it did over the last one. Most pairs that miss are through before.
inline constexpr int kPlainSteps = 2;
// A step of less than this share of the whole ends the search. Features that come as near as they move in that time are
// reported as touching.
inline constexpr double kLeastStep = 0x1p-44;
// A difference of coordinates, a product and two sums: four roundings of 2^-53 each, and one more for the bound itself.
inline constexpr double kRounding = 5.0 * 0x1p-53;
// Products that fall below the smallest normal double.
inline constexpr double kUnderflow = 0x1p-1060;
// Coordinates up to 2^60, and not all below 2^-60, have products of four that neither overflow nor vanish; others are
// scaled by a power of two.
inline constexpr double kLargest = 0x1p60;

namespace impact_detail {

using core::cross;
using core::dot;
using core::Vec3d;

// Each point of the first feature less each of the second: three of a vertex and a triangle, four of two edges.
struct Differences {
  int count = 0;
  Vec3d start[4];
  Vec3d end[4];
};

BROADSIDE_HD double scale_of(const MovingFeatures& f) {
  double most = 0.0;
  for (int k = 0; k < 4; ++k) most = fmax(most, fmax(largest_of(f.start[k]), largest_of(f.end[k])));
  if (!(most > kLargest) && !(most < 1.0 / kLargest && most > 0.0)) return 1.0;
  const int power = ilogb(most);
  return scalbn(1.0, power < -1000 ? 1000 : -power);
}

BROADSIDE_HD Differences differences(const MovingFeatures& f) {
  Differences out;
  const double scale = scale_of(f);
  const bool is_face = f.kind == FeatureKind::kVertexFace;
  out.count = is_face ? 3 : 4;
  for (int k = 0; k < out.count; ++k) {
    const int i = is_face ? 0 : k / 2;
    const int j = is_face ? k + 1 : 2 + k % 2;
    if (scale == 1.0) {
      out.start[k] = f.start[i] - f.start[j];
      out.end[k] = f.end[i] - f.end[j];
    } else {
      out.start[k] = scale * f.start[i] - scale * f.start[j];
      out.end[k] = scale * f.end[i] - scale * f.end[j];
    }
  }
  return out;
}

BROADSIDE_HD double bound_of(Vec3d d, Vec3d x) {
  return kRounding * (fabs(d.x * x.x) + fabs(d.y * x.y) + fabs(d.z * x.z)) + kUnderflow;
}

// Until when the direction surely parts the features, from `time` on: above 1 for the whole rest of the step, and no
// more than `time` when it proves nothing.
BROADSIDE_HD double parted_until(const Differences& x, Vec3d d, double time) {
  double until = 2.0;
  for (int k = 0; k < x.count; ++k) {
    const double first = dot(d, x.start[k]) - bound_of(d, x.start[k]);
    const double last = dot(d, x.end[k]) - bound_of(d, x.end[k]);
    if (first > 0.0 && last > 0.0) continue;
    if (!(first > 0.0) && !(last > 0.0)) return time;
    // The line from first to last is zero here, but for three roundings.
    const double zero = first / (first - last);
    if (first > 0.0)
      until = fmin(until, zero * (1.0 - 0x1p-51));
    else if (!(time > zero * (1.0 + 0x1p-51)))
      return time;
  }
  return until;
}

// The point of the triangle a b c nearest to the origin: by the region in which the origin lies.
BROADSIDE_HD Vec3d nearest_of_triangle(Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d u = b - a;
  const Vec3d v = c - a;
  const double ua = -dot(u, a), va = -dot(v, a);
  if (ua <= 0.0 && va <= 0.0) return a;
  const double ub = -dot(u, b), vb = -dot(v, b);
  if (ub >= 0.0 && vb <= ub) return b;
  const double area_c = ua * vb - ub * va;
  if (area_c <= 0.0 && ua >= 0.0 && ub <= 0.0 && ua > ub) return a + (ua / (ua - ub)) * u;
  const double uc = -dot(u, c), vc = -dot(v, c);
  if (vc >= 0.0 && uc <= vc) return c;
  const double area_b = uc * va - ua * vc;
  if (area_b <= 0.0 && va >= 0.0 && vc <= 0.0 && va > vc) return a + (va / (va - vc)) * v;
  const double area_a = ub * vc - uc * vb;
  const double from_b = vb - ub, from_c = uc - vc;
  if (area_a <= 0.0 && from_b >= 0.0 && from_c >= 0.0 && from_b + from_c > 0.0)
    return b + (from_b / (from_b + from_c)) * (c - b);
  // Along the normal, which keeps digits that weights of the corners would lose near the plane.
  const Vec3d n = cross(u, v);
  const double squared = dot(n, n);
  return squared > 0.0 ? (dot(n, a) / squared) * n : a;
}

BROADSIDE_HD double within_unit(double x) {
  return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x);
}

// The difference of the nearest points of two edges; x are its values at the four pairs of ends.
BROADSIDE_HD Vec3d nearest_of_edges(const Vec3d x[4]) {
  const Vec3d u = x[2] - x[0];
  const Vec3d v = x[0] - x[1];
  const Vec3d w = x[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 0.0 ? within_unit((uv * vw - vv * uw) / determinant) : 0.0;
  if (!(vv > 0.0)) return w + (uu > 0.0 ? within_unit(-uw / uu) : 0.0) * u;
  double r = (uv * s + vw) / vv;
  const bool is_inside = determinant > 0.0 && s > 0.0 && s < 1.0 && r > 0.0 && r < 1.0;
  if (is_inside) {
    const Vec3d n = cross(u, v);
    const double squared = dot(n, n);
    if (squared > 0.0) return (dot(n, w) / squared) * n;
  }
  if (r < 0.0 || r > 1.0) {
    r = within_unit(r);
    s = uu > 0.0 ? within_unit((uv * r - uw) / uu) : 0.0;
  }
  return w + s * u - r * v;
}

// Across the triangle, or across both edges, on the side of the first feature.
BROADSIDE_HD Vec3d across(const Differences& x, const Vec3d now[4]) {
  const Vec3d n = x.count == 3 ? cross(now[1] - now[0], now[2] - now[0]) : cross(now[2] - now[0], now[0] - now[1]);
  return dot(n, now[0]) < 0.0 ? -1.0 * n : n;
}

BROADSIDE_HD Vec3d unit(Vec3d d) {
  const double squared = dot(d, d);
  return squared > 0.0 ? (1.0 / sqrt(squared)) * d : d;
}

// A direction that turns: `first` at the beginning of the step and `last` at its end, linear between. The difference of
// two points along it is quadratic in time.
struct Turning {
  Vec3d first;
  Vec3d last;
};

// The quadratic's Bernstein coefficients on the step, and what rounding may have taken from any value of it.
struct Along {
  double begin, middle, end;
  double doubt;

  // The blossom: its value where both times are equal, and between two times the middle coefficient on that interval.
  BROADSIDE_HD double at(double s, double t) const {
    return (1.0 - s) * ((1.0 - t) * begin + t * middle) + s * ((1.0 - t) * middle + t * end);
  }
};

BROADSIDE_HD Along along(const Turning& d, Vec3d start, Vec3d end) {
  Along out;
  out.begin = dot(d.first, start);
  out.middle = 0.5 * (dot(d.first, end) + dot(d.last, start));
  out.end = dot(d.last, end);
  const double middles = bound_of(d.first, end) + bound_of(d.last, start);
  // Rounding of the coefficients, which the bounds are, and at most ten more roundings of values that are no larger.
  out.doubt = 3.0 * (bound_of(d.first, start) + middles + bound_of(d.last, end));
  return out;
}

// The first time after `time` at which the quadratic is about zero, at most 2.
BROADSIDE_HD double zero_after(const Along& g, double time) {
  const double here = g.at(time, time) - g.doubt;
  const double slope = 2.0 * (g.at(time, 1.0) - g.at(time, 0.0));
  const double bend = g.begin - 2.0 * g.middle + g.end;
  const double inner = slope * slope - 4.0 * bend * here;
  if (!(here > 0.0) || inner < 0.0) return here > 0.0 ? 2.0 : time;
  const double root = sqrt(inner);
  const double step = slope < 0.0 ? 2.0 * here / (root - slope) : (bend < 0.0 ? (slope + root) / (-2.0 * bend) : 2.0);
  return step < 2.0 ? time + step : 2.0;
}

// As parted_until with a direction that turns. The zeros are only estimates: the interval up to a time before them
// counts when all its Bernstein coefficients are above the doubt.
BROADSIDE_HD double parted_while_turning(const Differences& x, const Turning& d, double time) {
  double zero = 2.0;
  for (int k = 0; k < x.count; ++k) zero = fmin(zero, zero_after(along(d, x.start[k], x.end[k]), time));
  const bool is_whole = zero > 1.0;
  double share = is_whole ? 1.0 : 1.0 - 0x1p-40;
  for (int attempt = 0; attempt < 4; ++attempt) {
    const double until = is_whole && attempt == 0 ? 1.0 : time + share * (fmin(zero, 1.0) - time);
    bool is_parted = until > time;
    for (int k = 0; k < x.count && is_parted; ++k) {
      const Along g = along(d, x.start[k], x.end[k]);
      is_parted = fmin(g.at(time, time), fmin(g.at(time, until), g.at(until, until))) > g.doubt;
    }
    if (is_parted) return until >= 1.0 ? 2.0 : until;
    share = attempt == 0 ? 1.0 - 0x1p-16 : 0.5 * share;
  }
  return time;
}

BROADSIDE_HD Vec3d nearest(const Differences& x, double time, Vec3d now[4]) {
  for (int k = 0; k < x.count; ++k) now[k] = x.start[k] + time * (x.end[k] - x.start[k]);
  return unit(x.count == 3 ? nearest_of_triangle(now[0], now[1], now[2]) : nearest_of_edges(now));
}

}  // namespace impact_detail

// Coordinates are finite.
BROADSIDE_HD Impact first_impact(const MovingFeatures& features) {
  const impact_detail::Differences x = impact_detail::differences(features);
  core::Vec3d now[4];
  core::Vec3d before;  // the direction at `time_before`
  double time = 0.0;
  double time_before = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const core::Vec3d near = impact_detail::nearest(x, time, now);
    double until = impact_detail::parted_until(x, near, time);
    if (step >= kPlainSteps && until <= 1.0) {
      const core::Vec3d turn = (1.0 / (time - time_before)) * (near - before);
      const impact_detail::Turning turning{near - time * turn, near + (1.0 - time) * turn};
      until = fmax(until, impact_detail::parted_while_turning(x, turning, time));
    }
    if (until <= time + kLeastStep) until = fmax(until, impact_detail::parted_until(x, across(x, now), time));
    if (until > 1.0) return {};
    if (!(until > time + kLeastStep)) break;
    before = near;
    time_before = time;
    time = until;
  }
  return {true, time};
}

}  // namespace broadside::continuous
