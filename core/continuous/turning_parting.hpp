// Separating directions that turn along with the features. Where the features turn, a fixed direction stops separating
// them long before they meet, and a turning one keeps doing so. Used for queries that fixed directions and coplanar
// times leave undecided.
#pragma once

#include "core/continuous/parting.hpp"

namespace broadside::continuous {

// A direction that changes linearly from `first` at the start of the step to `last` at its end. The difference of two
// points along it is quadratic in time.
struct Turning {
  Triple<double> first;
  Triple<double> last;
};

namespace turning_detail {

BROADSIDE_HD double bound_of(const Triple<double>& d, const Triple<double>& x) {
  return kRounding * dot(magnitude(d), magnitude(x)) + kUnderflow;
}

// The quadratic's Bernstein coefficients on the step, and the most that rounding may have taken from any of its values.
struct Along {
  double begin, middle, end;
  double doubt;

  // The blossom. With both times equal it is the quadratic's value; with two times, the middle coefficient on that
  // interval.
  BROADSIDE_HD double at(double s, double t) const {
    return (1.0 - s) * ((1.0 - t) * begin + t * middle) + s * ((1.0 - t) * middle + t * end);
  }
};

BROADSIDE_HD Along along(const Turning& d, const Triple<double>& start, const Triple<double>& end) {
  Along out;
  out.begin = dot(d.first, start);
  out.middle = 0.5 * (dot(d.first, end) + dot(d.last, start));
  out.end = dot(d.last, end);
  const double middles = bound_of(d.first, end) + bound_of(d.last, start);
  // The bounds cover rounding of the coefficients; at most ten more roundings follow, of values that are no larger.
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

}  // namespace turning_detail

BROADSIDE_HD Triple<double> unit(const Triple<double>& d) {
  const double squared = dot(d, d);
  return squared > 0.0 ? (1.0 / sqrt(squared)) * d : d;
}

// As parted_until, for a turning direction. The zeros are only estimates: the interval up to a time before them is
// accepted when all Bernstein coefficients on it are above the doubt.
template <int kCount>
BROADSIDE_HD double parted_while_turning(const Differences<double, kCount>& x, const Turning& d, double time) {
  using namespace turning_detail;
  double zero = 2.0;
  for (int k = 0; k < kCount; ++k) zero = fmin(zero, zero_after(along(d, x.start[k], x.end[k]), time));
  const bool is_whole = zero > 1.0;
  double share = is_whole ? 1.0 : 1.0 - 0x1p-40;
  for (int attempt = 0; attempt < 4; ++attempt) {
    const double until = is_whole && attempt == 0 ? 1.0 : time + share * (fmin(zero, 1.0) - time);
    bool is_parted = until > time;
    for (int k = 0; k < kCount && is_parted; ++k) {
      const Along g = along(d, x.start[k], x.end[k]);
      is_parted = fmin(g.at(time, time), fmin(g.at(time, until), g.at(until, until))) > g.doubt;
    }
    if (is_parted) return until >= 1.0 ? 2.0 : until;
    share = attempt == 0 ? 1.0 - 0x1p-16 : 0.5 * share;
  }
  return time;
}

}  // namespace broadside::continuous
