// When two moving features first touch, computed in double. The time is never late, and early by no more than rounding
// requires. For host and device, for one query or several side by side; the same bits everywhere.
//
// Two certificates take turns. A direction that separates the features does so for an interval that follows in closed
// form (parting.hpp). While the four points of the features lie in no common plane, nothing touches
// (coplanar_times.hpp): this leads to just before the time at which the features touch or pass each other in one plane,
// and from there a direction leads on. Both prove every step, with rounding subtracted: a poor direction costs a step
// and never misses a touch. Queries that are undecided after a few such rounds, such as edges that stay parallel and
// features that stay in one plane, continue with directions that turn (turning_parting.hpp).
#pragma once

#include <cmath>

#include "core/continuous/coplanar_times.hpp"
#include "core/continuous/moving_features.hpp"
#include "core/continuous/parting.hpp"
#include "core/continuous/turning_parting.hpp"

namespace broadside::continuous {

// time: not later than the exact first touch, in units of the step. 1 when there is no touch.
struct Impact {
  bool touches = false;
  double time = 1.0;

  friend constexpr bool operator==(const Impact&, const Impact&) = default;
};

// Most rounds of both certificates. Ordinary impacts take one or two; features that pass through three common planes
// take four.
inline constexpr int kRounds = 6;
// Most steps with directions that turn. A query that is still undecided is then reported as a touch at the time it has
// reached, which is early.
inline constexpr int kMostSteps = 64;
// From this step on, the direction turns at the rate at which it turned over the previous step.
inline constexpr int kPlainSteps = 2;
// The search ends at a step shorter than this share of the whole. Features that come as near as they move in that time
// are reported as touching. kLeastRound ends the rounds, at 16 times as much: before a touch, rounds end where the
// volume is no larger than its own rounding error, and directions that do not turn would take many steps for the rest.
inline constexpr double kLeastStep = 0x1p-44;
inline constexpr double kLeastRound = 0x1p-40;
// When differences are at most 2^60 and not all below 2^-60, products of four of them neither overflow nor vanish.
// Otherwise the coordinates are first scaled by a power of two.
inline constexpr double kLargest = 0x1p60;

template <typename Real, int kCount>
BROADSIDE_HD auto is_of_usual_size(const Differences<Real, kCount>& x) {
  const Real largest = larger(larger(x.most.x, x.most.y), x.most.z);
  return (largest <= Real(kLargest)) & ((largest >= Real(1.0 / kLargest)) | (largest <= Real(0.0)));
}

// How far a query has come. time: above 1 when the features certainly never touch; otherwise there is no touch before
// it.
template <typename Real, typename Mask>
struct Search {
  Real time;
  Mask touches;  // they touch at `time`, as far as rounding can tell
  Mask is_open;  // neither is decided yet
};

// The first test: a world axis along which the features are apart at both ends, or one direction besides, proves that
// there is no touch. It decides most queries without a touch, at a small part of the cost of a search.
template <typename Real, int kCount>
BROADSIDE_HD auto is_apart_at_first_look(const Differences<Real, kCount>& x) {
  const Real zero(0.0);
  return is_apart_along_an_axis(x) | (parted_until(x, middle_direction(x), zero) > Real(1.0));
}

// Decides the rest, by rounds of both certificates. A query that is undecided at `limit` (at most 1) stops there,
// because a caller that wants the earliest of many touches needs no more.
template <typename Real, int kCount>
BROADSIDE_HD auto search(const Differences<Real, kCount>& x, const Volume<Real>& volume, Real limit) {
  Real time(0.0);
  auto is_open = !is_never_flat(volume);
  auto touches = time > Real(2.0);  // none
  for (int round = 0; round < kRounds && any(is_open); ++round) {
    time = pick(is_open, unflat_until(volume, time), time);
    is_open = is_open & (time <= limit);
    Triple<Real> now[kCount];
    places_at(x, time, now);
    const Real until = larger(time, parted_until(x, nearest(now), time));
    const auto is_stuck = is_open & (until <= time + Real(kLeastRound));
    touches = touches | is_stuck;
    is_open = is_open & !is_stuck;
    time = pick(is_open, until, time);
    is_open = is_open & (time <= limit);
  }
  return Search<Real, decltype(is_open)>{time, touches, is_open};
}

// Decides what is still open after that, with directions that turn.
template <int kCount>
BROADSIDE_HD Impact turning_search(const Differences<double, kCount>& x, double time) {
  Triple<double> now[kCount];
  Triple<double> before;  // the direction at `time_before`
  double time_before = time;
  for (int step = 0; step < kMostSteps; ++step) {
    places_at(x, time, now);
    const Triple<double> near = unit(nearest(now));
    double until = parted_until(x, near, time);
    if (step >= kPlainSteps && until <= 1.0) {
      const Triple<double> turn = (1.0 / (time - time_before)) * (near - before);
      const Turning turning{near - time * turn, near + (1.0 - time) * turn};
      until = fmax(until, parted_while_turning(x, turning, time));
    }
    if (until <= time + kLeastStep) until = fmax(until, parted_until(x, across(now), time));
    if (until > 1.0) return {};
    if (!(until > time + kLeastStep)) break;
    before = near;
    time_before = time;
    time = until;
  }
  return {true, time};
}

// The power of two by which coordinates are multiplied first; 1 when none is needed.
BROADSIDE_HD double scale_of(const MovingFeatures& f) {
  double most = 0.0;
  for (int k = 0; k < 4; ++k) most = fmax(most, fmax(largest_of(f.start[k]), largest_of(f.end[k])));
  if (!(most > kLargest) && !(most < 1.0 / kLargest && most > 0.0)) return 1.0;
  const int power = ilogb(most);
  return scalbn(1.0, power < -1000 ? 1000 : -power);
}

template <int kCount>
BROADSIDE_HD Differences<double, kCount> differences_of(const MovingFeatures& f) {
  Triple<double> start[4], end[4];
  for (int k = 0; k < 4; ++k) start[k] = triple(f.start[k]), end[k] = triple(f.end[k]);
  const Differences<double, kCount> x = differences<kCount>(start, end);
  if (is_of_usual_size(x)) return x;
  const double scale = scale_of(f);
  for (int k = 0; k < 4; ++k) start[k] = scale * start[k], end[k] = scale * end[k];
  return differences<kCount>(start, end);
}

template <int kCount>
BROADSIDE_HD Impact first_impact_of(const MovingFeatures& f) {
  const Differences<double, kCount> x = differences_of<kCount>(f);
  if (is_apart_at_first_look(x)) return {};
  const auto found = search(x, volume_of(x), 1.0);
  if (found.is_open) return turning_search(x, found.time);
  return found.touches ? Impact{true, found.time} : Impact{};
}

// Precondition: all coordinates are finite.
BROADSIDE_HD Impact first_impact(const MovingFeatures& features) {
  return features.kind == FeatureKind::kVertexFace ? first_impact_of<kFaceCount>(features)
                                                   : first_impact_of<kEdgeCount>(features);
}

}  // namespace broadside::continuous
