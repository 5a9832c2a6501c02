// Contact by small substeps, soft constraints and relaxation: RIGID 8.5, after Catto, Solver2D (2024), his "soft step",
// and Macklin et al., Small Steps in Physics Simulation (2019).
//
// A substep: velocities get gravity and the impulses of the substep before; one sweep pushes overlaps apart; bodies
// move; one sweep takes back the velocity that only pushed them apart; what came fast bounces. Departures: friction is
// Coulomb's cone, solved as a vector after the normal impulses that bound it; a bounce happens in its substep and not
// at the end of the step; arms and gaps are those of the start, followed to first order.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

// Sweeps over the normal impulses of one patch while its bodies are at hand, forward and backward in turns: its points
// share both bodies, and one sweep alone would leave a turn toward the last of them.
inline constexpr int kSweepsOfPatch = 2;
// Of a bounce: what is left after these is below a thousandth of it, for the four corners of a cube.
inline constexpr int kSweepsOfBounce = 8;

// Numbers of one substep, the same for all contacts.
struct SoftStep {
  float dt_s = 0.0F;  // of the substep
  float per_dt_s = 0.0F;
  // An overlap's share that a substep takes away, per second; and how much of the impulse is kept soft.
  float push_rate_per_s = 0.0F;
  float mass_scale = 1.0F;
  float impulse_scale = 0.0F;
  float fastest_push_m_s = 0.0F;
  float slop_m = 0.0F;
  float bounce_from_m_s = 0.0F;  // approach speeds above this bounce
};

// Natural frequency and damping of the soft constraint in units of the substep: omega h and zeta.
BROADSIDE_HD SoftStep soft_step(float dt_s, float omega_dt, float damping) {
  SoftStep s;
  s.dt_s = dt_s;
  s.per_dt_s = 1.0F / dt_s;
  const float a1 = 2.0F * damping + omega_dt;
  const float a2 = omega_dt * a1;
  const float a3 = 1.0F / (1.0F + a2);
  s.push_rate_per_s = omega_dt * s.per_dt_s / a1;
  s.mass_scale = a2 * a3;
  s.impulse_scale = a3;
  return s;
}

// The gap now: that of the start, and how far the bodies moved along the normal since.
BROADSIDE_HD float gap_now(const PatchConstraint& c, const PatchPoint& p, const SolverBody& a, const SolverBody& b) {
  const Vec3 moved_a = a.moved + cross(a.turned, p.arm_a);
  const Vec3 moved_b = b.moved + cross(b.turned, p.arm_b);
  return p.gap_m + dot(c.normal, moved_a - moved_b);
}

// The k-th point of sweeps that go forward and backward in turns.
BROADSIDE_HD constexpr int point_of_sweeps(int k, int count) {
  const int at = k % count;
  return (k / count) % 2 == 0 ? at : count - 1 - at;
}

// Friction after the normal impulses: what would stop the point, if static friction can; else kinetic friction against
// the slip. With one mass for both directions of a sliding point its friction turns until it opposes the slip.
BROADSIDE_HD void solve_friction(const PatchConstraint& c, PatchPoint& p, PatchMotion& m, const SolverBody& a,
                                 const SolverBody& b) {
  const Vec3 v = relative_velocity(m, p);
  const float v1 = dot(v, c.tangent_1);
  const float v2 = dot(v, c.tangent_2);
  float want_1 = p.tangent_impulse_1 - (p.stick_mass_11 * v1 + p.stick_mass_12 * v2);
  float want_2 = p.tangent_impulse_2 - (p.stick_mass_12 * v1 + p.stick_mass_22 * v2);
  float most = (p.slides ? c.surface.mu_kinetic : c.surface.mu_static) * p.normal_impulse;
  if (want_1 * want_1 + want_2 * want_2 > most * most) {
    p.slides = true;
    most = c.surface.mu_kinetic * p.normal_impulse;
    want_1 = p.tangent_impulse_1 - p.slide_mass * v1;
    want_2 = p.tangent_impulse_2 - p.slide_mass * v2;
    const float size = sqrtf(want_1 * want_1 + want_2 * want_2);
    if (size > most) {
      want_1 = (most / size) * want_1;
      want_2 = (most / size) * want_2;
    }
  }
  const float change_1 = want_1 - p.tangent_impulse_1;
  const float change_2 = want_2 - p.tangent_impulse_2;
  p.tangent_impulse_1 = want_1;
  p.tangent_impulse_2 = want_2;
  push(m, a, b, p, change_1 * c.tangent_1 + change_2 * c.tangent_2);
}

// Before anything else of a substep: how fast the points come.
BROADSIDE_HD void note_approach(PatchConstraint& c, const SolverBody& a, const SolverBody& b) {
  const PatchMotion m = motion_of(a, b);
  for (int k = 0; k < c.count; ++k) c.points[k].approach_m_s = -dot(c.normal, relative_velocity(m, c.points[k]));
}

// The impulses of the substep before.
BROADSIDE_HD void warm_start(PatchConstraint& c, SolverBody& a, SolverBody& b) {
  PatchMotion m = motion_of(a, b);
  for (int k = 0; k < c.count; ++k) {
    PatchPoint& p = c.points[k];
    p.slides = false;
    push(m, a, b, p,
         (p.normal_impulse * c.normal + p.tangent_impulse_1 * c.tangent_1) + p.tangent_impulse_2 * c.tangent_2);
  }
  store(m, a, b);
}

// One sweep over a patch. pushes: overlaps are pushed apart; else they are only kept from growing.
BROADSIDE_HD void solve_patch(PatchConstraint& c, SolverBody& a, SolverBody& b, const SoftStep& step, bool pushes) {
  PatchMotion m = motion_of(a, b);
  for (int k = 0; k < kSweepsOfPatch * c.count; ++k) {
    PatchPoint& p = c.points[point_of_sweeps(k, c.count)];
    const float gap = gap_now(c, p, a, b);
    const float speed = dot(c.normal, relative_velocity(m, p));
    // The step may end here: relaxing stops no point before it comes.
    if (gap > 0.0F && !pushes && !(p.normal_impulse > 0.0F)) continue;
    float change;
    if (gap > 0.0F) {
      change = -p.normal_mass * (speed + gap * step.per_dt_s);  // it may close within the substep, no more
    } else if (pushes) {
      const float over = gap + step.slop_m;
      const float wish = over < 0.0F ? over * step.push_rate_per_s : 0.0F;
      const float bias = wish < -step.fastest_push_m_s ? -step.fastest_push_m_s : wish;
      change = -p.normal_mass * step.mass_scale * (speed + bias) - step.impulse_scale * p.normal_impulse;
    } else {
      change = -p.normal_mass * speed;
    }
    const float sum = p.normal_impulse + change;
    const float next = sum > 0.0F ? sum : 0.0F;
    change = next - p.normal_impulse;
    p.normal_impulse = next;
    push(m, a, b, p, change * c.normal);
  }
  for (int k = 0; k < c.count; ++k) solve_friction(c, c.points[k], m, a, b);
  store(m, a, b);
}

// Whether the point came fast enough to bounce, and was met in this substep.
BROADSIDE_HD bool bounces(const PatchConstraint& c, const PatchPoint& p, const SoftStep& step) {
  return c.surface.restitution > 0.0F && p.approach_m_s > step.bounce_from_m_s && p.normal_impulse > 0.0F;
}

BROADSIDE_HD bool bounces(const PatchConstraint& c, const SoftStep& step) {
  bool any = false;
  for (int k = 0; k < c.count; ++k) any = any || bounces(c, c.points[k], step);
  return any;
}

// One sweep over a patch: points that came fast leave with the share of that speed that restitution gives back.
BROADSIDE_HD void bounce(PatchConstraint& c, SolverBody& a, SolverBody& b, const SoftStep& step) {
  PatchMotion m = motion_of(a, b);
  for (int k = 0; k < kSweepsOfBounce * c.count; ++k) {
    PatchPoint& p = c.points[point_of_sweeps(k, c.count)];
    if (!bounces(c, p, step)) continue;
    const float speed = dot(c.normal, relative_velocity(m, p));
    const float sum = p.normal_impulse + p.normal_mass * (c.surface.restitution * p.approach_m_s - speed);
    const float next = sum > 0.0F ? sum : 0.0F;
    const float change = next - p.normal_impulse;
    p.normal_impulse = next;
    push(m, a, b, p, change * c.normal);
  }
  for (int k = 0; k < c.count; ++k) solve_friction(c, c.points[k], m, a, b);
  store(m, a, b);
}

// Ends a substep. What bounced leaves: the next substep does not begin with the impulse of the impact.
BROADSIDE_HD void add_to_totals(PatchConstraint& c, const SoftStep& step) {
  for (int k = 0; k < c.count; ++k) {
    PatchPoint& p = c.points[k];
    p.normal_total = p.normal_total + p.normal_impulse;
    p.tangent_total_1 = p.tangent_total_1 + p.tangent_impulse_1;
    p.tangent_total_2 = p.tangent_total_2 + p.tangent_impulse_2;
    if (bounces(c, p, step)) p.normal_impulse = p.tangent_impulse_1 = p.tangent_impulse_2 = 0.0F;
  }
}

// N s on A, of the whole step.
BROADSIDE_HD Vec3 total_impulse(const PatchConstraint& c, const PatchPoint& p) {
  return (p.normal_total * c.normal + p.tangent_total_1 * c.tangent_1) + p.tangent_total_2 * c.tangent_2;
}

}  // namespace broadside::core
