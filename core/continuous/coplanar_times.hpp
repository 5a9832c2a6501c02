// When four moving points can lie in one plane, which is necessary for their features to touch. The volume of the
// tetrahedron that they span is a cubic in time; over an interval in which it is certainly not zero, nothing touches.
// For one query, or several side by side (lane_math.hpp).
#pragma once

#include "core/continuous/parting.hpp"

namespace broadside::continuous {

// The volume's Bernstein coefficients on the step, and a bound of the rounding error of each.
template <typename Real>
struct Volume {
  Real at[4];
  Real doubt;
};

// Rounding error of one coefficient, relative to the sum of the magnitudes of its six products. Each product has three
// factors that are differences of coordinates. The cross product adds a product, a difference and the sum of two such
// terms; the dot product adds a product and two sums; then come a sum and a product with a third that is itself
// rounded. That makes 12 roundings of 2^-53, plus those of the sum of magnitudes.
inline constexpr double kVolumeRounding = 16.0 * 0x1p-53;
// A split has three layers, each a difference of up to twice the largest coefficient, a product and a sum: 15
// roundings.
inline constexpr double kSplitRounding = 16.0 * 0x1p-53;
// Each step of Newton's method doubles the number of correct digits, once there are one or two.
inline constexpr int kGuesses = 5;
// Roundings of a split and a dozen more, of values that are at most three times the largest coefficient.
inline constexpr double kGuessRounding = 64.0 * 0x1p-53;
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

// True when the points certainly lie in no common plane during the whole step.
template <typename Real>
BROADSIDE_HD auto is_never_flat(const Volume<Real>& volume) {
  const Real least = lesser(lesser(volume.at[0], volume.at[1]), lesser(volume.at[2], volume.at[3]));
  const Real most = larger(larger(volume.at[0], volume.at[1]), larger(volume.at[2], volume.at[3]));
  return (least > volume.doubt) | (most < Real(0.0) - volume.doubt);
}

// Bernstein coefficients on the two parts of an interval, before and after a given share of it.
template <typename Real>
struct Split {
  Real before[4];
  Real behind[4];
};

// Lower bounds of the coefficients: the most that rounding may have added is subtracted.
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

// The time, from `time` on, up to which the points certainly lie in no common plane: above 1 for the whole rest of the
// step, and at most `time` when they may lie in one now. The steepest line from the first coefficient to another one
// lies below the control polygon, and so below the volume: the volume has no zero before that line's zero. From there
// Newton's method guesses the zero of the volume, and the coefficients on the part before the guess prove it. Where
// they do not, the line's zero is returned.
template <typename Real>
BROADSIDE_HD Real unflat_until(const Volume<Real>& volume, const Real& time) {
  const Real zero(0.0), one(1.0);
  Real g[4];
  // The sign of the volume now. Just after a time at which the volume is about zero, the first coefficient gives it.
  const auto is_below = split(volume.at, time).behind[0] < zero;
  for (int k = 0; k < 4; ++k) g[k] = pick(is_below, zero - volume.at[k], volume.at[k]) - volume.doubt;
  const Split<Real> rest = split(g, time);
  const Real& here = rest.behind[0];
  const Real slope =
      larger(larger(Real(3.0) * (here - rest.behind[1]), Real(1.5) * (here - rest.behind[2])), here - rest.behind[3]);
  const auto is_above = here > zero;
  const auto meets = is_above & (slope > here);
  const auto is_clear = is_above & !(slope > here);
  const Real share = pick(meets, here, zero) / pick(meets, slope, one);
  const Real from = time + share * (one - time);
  const Split<Real> tail = split(rest.behind, share);
  const Real(&h)[4] = tail.behind;
  // The guess aims a little above zero, by what one more split and Newton's method may round.
  const Real most = larger(larger(magnitude(h[0]), magnitude(h[1])), larger(magnitude(h[2]), magnitude(h[3])));
  const Real a0 = h[0] - Real(kGuessRounding) * most;
  const Real a1 = Real(3.0) * (h[1] - h[0]);
  const Real a2 = Real(3.0) * ((h[2] - h[1]) - (h[1] - h[0]));
  const Real a3 = (h[3] - h[0]) - Real(3.0) * (h[2] - h[1]);
  Real guess(0.0);
  for (int k = 0; k < kGuesses; ++k) {
    const Real value = a0 + guess * (a1 + guess * (a2 + guess * a3));
    const Real rate = a1 + guess * (Real(2.0) * a2 + guess * (Real(3.0) * a3));
    const auto falls = rate < zero;
    guess = pick(falls, within_unit(guess - value / pick(falls, rate, one)), one);
  }
  const Split<Real> parts = split(h, guess);
  const Real(&b)[4] = parts.before;
  const auto is_proved = meets & (lesser(lesser(b[0], b[1]), lesser(b[2], b[3])) > zero);
  const Real until = pick(is_proved, from + guess * (one - from), from) - Real(kTimeRounding);
  return pick(is_clear, Real(2.0), larger(time, until));
}

}  // namespace broadside::continuous
