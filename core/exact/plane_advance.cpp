#include "core/exact/plane_advance.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace broadside::exact {
namespace {

// Each step takes one step of Newton's method and one of the chord, not a halving: this many suffice for any curve.
constexpr int kRootSteps = 10;
// The search stops when the time is this near to the zero of the bound, as a share of that time. It only affects how
// often bodies are measured.
constexpr double kNearEnough = 1e-4;

// The share of a chord's length that is taken: short enough that rounding leaves the bound above zero there.
constexpr double kBeforeZero = 1.0 - 0x1p-20;

// The signed distance of a point from the plane through B's current origin, and its rate of change.
struct Line {
  double value;
  double rate;
};

Line line_of(const MovingPoints& body, Point p, Point normal, Point turned, const MovingPoints& b) {
  const Point from = p - b.origin;
  const Point velocity = body.velocity_m + cross(body.rotation_rad, p - body.origin) - b.velocity_m;
  return {dot(normal, from), dot(turned, from) + dot(normal, velocity)};
}

// The lower envelope of A's lines, minus the upper envelope of B's, minus the gap and the bend: concave in the time
// ahead.
struct Bound {
  std::vector<Line> a;
  std::vector<Line> b;
  double gap = 0.0;
  double bend = 0.0;

  [[nodiscard]] Line at(double ahead) const {
    const auto height = [&](const Line& l) { return l.value + l.rate * ahead; };
    const auto lower = [&](const Line& p, const Line& q) { return height(p) < height(q); };
    const Line& least = *std::min_element(a.begin(), a.end(), lower);
    const Line& most = *std::max_element(b.begin(), b.end(), lower);
    return {height(least) - height(most) - gap - 0.5 * bend * ahead * ahead, least.rate - most.rate - bend * ahead};
  }
};

// Bounds the second derivative of the distance of a body's point from the plane: |(n . x)''| <= |n''| |x| + 2 |n'| |x'|
// + |x''|.
double bend_of(const MovingPoints& body, const MovingPoints& b, double turn, double remaining) {
  const double spin = length(body.rotation_rad);
  const double drift = length(body.velocity_m - b.velocity_m);
  const double far = length(body.origin - b.origin) + drift * remaining + body.reach_m;
  return turn * turn * far + 2.0 * turn * (drift + spin * body.reach_m) + spin * spin * body.reach_m;
}

}  // namespace

double gap_along(const MovingPoints& a, const MovingPoints& b, Point normal) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const Point p : a.points) least = std::min(least, dot(normal, p - b.origin));
  for (const Point p : b.points) most = std::max(most, dot(normal, p - b.origin));
  return least - most;
}

double parted_until(const MovingPoints& a, const MovingPoints& b, Point normal, Point turn_rad, double gap_m,
                    double now) {
  const double remaining = 1.0 - now;
  const Point turned = cross(turn_rad, normal);
  const double turn = length(turn_rad);
  Bound bound;
  for (const Point p : a.points) bound.a.push_back(line_of(a, p, normal, turned, b));
  for (const Point p : b.points) bound.b.push_back(line_of(b, p, normal, turned, b));
  bound.gap = gap_m;
  bound.bend = bend_of(a, b, turn, remaining) + bend_of(b, b, turn, remaining);
  Line low = bound.at(0.0);
  if (!(low.value > 0.0)) return now;
  Line high = bound.at(remaining);
  if (high.value > 0.0) return 2.0;
  // The bound is concave: a chord's zero lies before the bound's zero, and a tangent's zero after it.
  double safe = 0.0;
  double late = remaining;
  for (int step = 0; step < kRootSteps && late - safe > kNearEnough * late; ++step) {
    const double chord = safe + kBeforeZero * (late - safe) * (low.value / (low.value - high.value));
    const double tangent = late - high.value / high.rate;
    if (tangent > safe && tangent < late) {
      late = tangent;
      high = bound.at(late);
    }
    const Line found = bound.at(chord);
    if (!(chord > safe) || !(found.value > 0.0)) break;
    safe = chord;
    low = found;
    if (high.value > 0.0) return now + late;
  }
  return now + safe;
}

double parted_until_by_any(const MovingPoints& a, const MovingPoints& b, Point normal, Point turn_rad, double gap_m,
                           double now) {
  double until = now;
  for (const Point turn : {Point{}, a.rotation_rad, b.rotation_rad, turn_rad}) {
    until = std::max(until, parted_until(a, b, normal, turn, gap_m, now));
    if (until > 1.0) break;
  }
  return until;
}

}  // namespace broadside::exact
