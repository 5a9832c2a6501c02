#include "bench/forensics/flight_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/rounding.hpp"

namespace broadside::bench {
namespace {

using validation::BodyState;
using validation::kSubnormal;
using validation::length;

// How many operations an engine rounds to compute h g: one where it multiplies, five where it uses forces (the mass, m
// g, 1 / m, and two products).
constexpr double kMethodPull = 1.0;
constexpr double kForcePull = 5.0;

double largest(validation::Vec3d v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

bool have_one_integrator(const core::TraceHeader& a, const core::TraceHeader& b) {
  if (a.declaration.follows_method() && b.declaration.follows_method()) return true;
  const auto same = [&](std::string_view key) { return a.declaration.text(key) == b.declaration.text(key); };
  return a.declaration.declares("integrator") && same("integrator") && same("order") && same("substeps");
}

}  // namespace

FlightParty::FlightParty(const core::TraceHeader& header)
    : roundoff(validation::state_roundoff(header)),
      substeps(header.declaration.number("substeps")),
      order(header.declaration.number("order")),
      pull_operations(header.declaration.follows_method() ? kMethodPull : kForcePull) {}

FlightBounds::FlightBounds(const core::TraceHeader& a, const core::TraceHeader& b)
    : h_s_(a.scene.dt_s),
      pull_m_s_(h_s_ * largest(validation::Vec3d(a.scene.gravity_m_s2))),
      parties_{FlightParty(a), FlightParty(b)},
      is_one_integrator_(have_one_integrator(a, b)),
      facts_(validation::facts_of(a.scene)),
      bounds_(facts_.size()) {}

void FlightBounds::advance(std::size_t body, const BodyState& before, const BodyState& after) {
  if (!facts_[body].is_dynamic) return;
  FlightBound& b = bounds_[body];
  const double v = std::max(largest(before.v), largest(after.v));
  const double x = std::max(largest(before.x), largest(after.x));
  for (const FlightParty& p : parties_) {
    const double u = p.roundoff;
    b.velocity_m_s += p.substeps * (u * v + 2.0 * kSubnormal) + p.pull_operations * u * pull_m_s_;
    b.position_m += p.substeps * (u * (x + h_s_ * v) + 2.0 * kSubnormal);
    if (!is_one_integrator_ && p.order < 2.0) b.position_m += 0.5 * h_s_ * pull_m_s_ / p.substeps;
  }
  b.position_m += h_s_ * b.velocity_m_s;
  advance_turning(body, before, after);
}

void FlightBounds::advance_turning(std::size_t body, const BodyState& before, const BodyState& after) {
  const validation::BodyFacts& f = facts_[body];
  FlightBound& b = bounds_[body];
  const double spin = std::max(length(before.w), length(after.w));
  if (!f.has_inertia || has_outgrown(body)) return;
  const double turn = h_s_ * spin;
  const double momentum = f.largest_moment * spin;
  const double torque =
      std::max(length(cross(before.w, before.angular_momentum)), length(cross(after.w, after.angular_momentum)));
  const double change = h_s_ * length(after.w - before.w);
  double angle = 0.0;
  for (const FlightParty& p : parties_) {
    const double u = p.roundoff;
    const double higher = p.order < 2.0 ? 1.0 : std::pow(std::min(1.0, turn), p.order - 1.0);
    b.momentum_kg_m2_s += 0.5 * h_s_ * torque * higher + p.substeps * 40.0 * u * momentum;
    angle += (change + turn * turn * turn / 12.0) * higher + p.substeps * (24.0 * u + 8.0 * u * turn);
  }
  b.spin_rad_s = b.momentum_kg_m2_s / f.least_moment +
                 momentum * (1.0 / f.least_moment - 1.0 / f.largest_moment) * std::min(2.0, b.angle_rad);
  b.angle_rad += angle + h_s_ * b.spin_rad_s;
}

bool FlightBounds::has_outgrown(std::size_t body) const {
  return bounds_[body].angle_rad >= std::numbers::pi;
}

}  // namespace broadside::bench
