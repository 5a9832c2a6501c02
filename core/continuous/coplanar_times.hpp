// When four moving points can lie in one plane: features that touch do. The volume of the points is a cubic in time; an
// interval in which it is surely not zero holds no touch. For one query, or several side by side (lane_math.hpp).
#pragma once

#include "core/continuous/parting.hpp"

namespace broadside::continuous {

// Bernstein coefficients on the step, and what rounding may have changed of each.
template <typename Real>
struct Volume {
  Real at[4];
  Real doubt;
};

// Of a coefficient: differences of coordinates in three factors, a product and a difference and the sum of two of them
// in the cross product, a product and two sums in the other one, a sum and a product with a third that is rounded: 12
// roundings of 2^-53 of six products, and those of their sum.
inline constexpr double kVolumeRounding = 16.0 * 0x1p-53;
// A split is three layers of a difference of up to twice the largest coefficient, a product and a sum: 15 roundings.
inline constexpr double kSplitRounding = 16.0 * 0x1p-53;
inline constexpr int kClips = 5;
// Times are sums of a dozen rounded products below 1.
inline constexpr double kTimeRounding = 0x1p-49;

template <typename Real, int kCount>
BROADSIDE_HD Volume<Real> volume_of(const Differences<Real, kCount>& x) {
  const Triple<Real> first = cross(x.start[1], x.start[2]);
  const Triple<Real> middle = cross(x.start[1], x.end[2]) + cross(x.end[1], x.start[2]);
  const Triple<Real> last = cross(x.end[1], x.end[2]);
  const Triple<Real>&a = x.reach[0], &b = x.reach[1], &c = x.reach[2];
  const Real six = (a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z)) + a.z * (b.x * c.y + b.y * c.x);
  const Real third(1.0 / 3.0);
  return {{dot(x.start[0], first), (dot(x.start[0], middle) + dot(x.end[0], first)) * third,
           (dot(x.start[0], last) + dot(x.end[0], middle)) * third, dot(x.end[0], last)},
          Real(kVolumeRounding) * six + Real(kUnderflow)};
}

// The points are surely in no plane during the whole step.
template <typename Real>
BROADSIDE_HD auto is_never_flat(const Volume<Real>& volume) {
  const Real least = lesser(lesser(volume.at[0], volume.at[1]), lesser(volume.at[2], volume.at[3]));
  const Real most = larger(larger(volume.at[0], volume.at[1]), larger(volume.at[2], volume.at[3]));
  return (least > volume.doubt) | (most < Real(0.0) - volume.doubt);
}

// Coefficients on the parts before and behind a share of an interval.
template <typename Real>
struct Split {
  Real before[4];
  Real behind[4];
};

// Less what its rounding may have added.
template <typename Real>
BROADSIDE_HD Split<Real> split(const Real (&g)[4], const Real& share) {
  const Real most = larger(larger(magnitude(g[0]), magnitude(g[1])), larger(magnitude(g[2]), magnitude(g[3])));
  const Real doubt = Real(kSplitRounding) * most;
  const Real a = g[0] + share * (g[1] - g[0]);
  const Real b = g[1] + share * (g[2] - g[1]);
  const Real c = g[2] + share * (g[3] - g[2]);
  const Real d = a + share * (b - a);
  const Real e = b + share * (c - b);
  const Real f = (d + share * (e - d)) - doubt;
  return {{g[0] - doubt, a - doubt, d - doubt, f}, {f, e - doubt, c - doubt, g[3] - doubt}};
}

// Until when the points are surely in no plane, from `time` on: above 1 for the whole rest of the step, and no more
// than `time` when they may be in one now. The steepest line from the first coefficient to another one lies below the
// polygon of all, and so below the volume: no zero lies before its own. A line from the last coefficient, where the
// volume has changed its sign, cuts off what lies behind a zero; so the lines close in on it, as Bezier clipping does.
template <typename Real>
BROADSIDE_HD Real unflat_until(const Volume<Real>& volume, const Real& time) {
  const Real zero(0.0);
  Real g[4];
  // The sign of now: behind a time at which it is about zero, the first coefficient there says which it is.
  const auto is_below = split(volume.at, time).behind[0] < zero;
  for (int k = 0; k < 4; ++k) g[k] = pick(is_below, zero - volume.at[k], volume.at[k]) - volume.doubt;
  {
    const Split<Real> parts = split(g, time);
    for (int k = 0; k < 4; ++k) g[k] = parts.behind[k];
  }
  Real from = time;
  Real to(1.0);
  auto is_open = g[0] > zero;
  auto is_clear = time > Real(2.0);  // none
  for (int clip = 0; clip < kClips && any(is_open); ++clip) {
    const Real slope = larger(larger(Real(3.0) * (g[0] - g[1]), Real(1.5) * (g[0] - g[2])), g[0] - g[3]);
    const auto meets = slope > g[0];
    // Without a zero up to `to`: the rest of the step is clear, if that is its end.
    is_clear = is_clear | (is_open & !meets & (to >= Real(1.0)));
    from = pick(is_open & !meets, to, from);
    is_open = is_open & meets;
    const Real share = pick(is_open, g[0], zero) / pick(is_open, slope, Real(1.0));
    const Split<Real> left = split(g, share);
    from = from + share * (to - from);
    for (int k = 0; k < 4; ++k) g[k] = left.behind[k];
    const auto ends_below = is_open & (g[3] < zero) & (g[0] > zero);
    const Real back = larger(larger(Real(3.0) * (g[2] - g[3]), Real(1.5) * (g[1] - g[3])), g[0] - g[3]);
    const Real kept = Real(1.0) + pick(ends_below, g[3], zero) / pick(ends_below, back, Real(1.0));
    const Split<Real> right = split(g, kept);
    to = pick(ends_below, from + kept * (to - from), to);
    for (int k = 0; k < 4; ++k) g[k] = pick(ends_below, right.before[k], g[k]);
    is_open = is_open & (g[0] > zero) & (to - from > Real(kTimeRounding));
  }
  return pick(is_clear, Real(2.0), larger(time, from - Real(kTimeRounding)));
}

}  // namespace broadside::continuous
