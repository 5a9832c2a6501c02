// Contact by small substeps, soft constraints and relaxation: RIGID 8.5, after Catto, Solver2D (2024), his "soft step",
// and Macklin et al., Small Steps in Physics Simulation (2019).
//
// A substep: velocities get gravity and the impulses of the substep before; sweeps hold the bodies at the slop, softly;
// bodies move; one sweep takes back the velocity that only pushed them apart; points that approached fast at the start
// of the step bounce in the substep in which they first touch.
//
// Departures: friction is Coulomb's cone, solved as a vector after the normal impulses that bound it. Arms and gaps are
// those of the start, followed to first order. A gap at rest is one slop below 0, because the contact law is linear
// there. At a gap of 0 the law has a kink, on which a stack never comes to rest.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/fused.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_step.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

// Whether the point approached fast enough to bounce.
template <typename Number>
BROADSIDE_HD TruthOf<Number> came_fast(const PatchOf<Number>& c, const PatchPointOf<Number>& p) {
  const TruthOf<Number> gives_back = c.surface.restitution > 0.0F;
  const TruthOf<Number> is_fast = p.approach_m_s > 0.0F;
  return gives_back & is_fast;
}

// Whether the point approached fast and did not touch in an earlier substep. A body that bounced leaves; if neighbors
// drive it back, it comes at another speed.
template <typename Number>
BROADSIDE_HD TruthOf<Number> may_bounce(const PatchOf<Number>& c, const PatchPointOf<Number>& p) {
  const TruthOf<Number> was_met = p.normal_total > 0.0F;
  return came_fast(c, p) & !was_met;
}

// Before anything else of a step: notes the approach speeds of the points that are fast enough to bounce. Returns
// whether there is such a point. A patch without one gets no restitution in this step, so that later stages need not
// look at its points again.
BROADSIDE_HD bool note_approach(PatchConstraint& c, const SolverBody& a, const SolverBody& b, const SoftStep& step) {
  const PatchMotion m = motion_of<float>(c, a, b);
  bool is_fast = false;
  each_point(c, [&](int k) {
    PatchPoint& p = c.points[k];
    const float approach = -normal_speed(m.twist, p.lever);
    p.approach_m_s = approach > step.bounce_from_m_s ? approach : 0.0F;
    is_fast = is_fast || came_fast(c, p);
  });
  if (!is_fast) c.surface.restitution = 0.0F;
  return is_fast;
}

// The largest speed of a point relative to the other body, m/s.
template <typename Number>
BROADSIDE_HD Number fastest_point(const PatchOf<Number>& c, const PatchMotionOf<Number>& m) {
  Number squared = 0.0F;
  each_point(c, [&](int k) {
    const VectorOf<Number>& lever = c.points[k].lever;
    const VectorOf<Number> v = {normal_speed(m.twist, lever), tangent_1_speed(m.twist, lever),
                                tangent_2_speed(m.twist, lever)};
    const Number of_point = fused_dot(v, v);
    squared = pick(of_point > squared, of_point, squared);
  });
  return square_root(squared);
}

// Before anything else of a substep: nothing slides yet.
template <typename Number>
BROADSIDE_HD void forget_slips(PatchOf<Number>& c) {
  each_point_or_zeros(c, [&](int k) { c.points[k].slides = false; });
}

// What all impulses of a patch are together.
template <typename Number>
BROADSIDE_HD WorldPushOf<Number> whole_push(const PatchOf<Number>& c) {
  PatchPushOf<Number> given;
  each_point_or_zeros(c, [&](int k) {
    const PatchPointOf<Number>& p = c.points[k];
    given.add_normal(p.lever, p.normal_impulse);
    given.add_tangents(p.lever, p.tangent_impulse_1, p.tangent_impulse_2);
  });
  return in_world(c, given);
}

// The impulses of the substep before.
template <typename Number, typename Body>
BROADSIDE_HD void warm_start(const PatchOf<Number>& c, Body& a, Body& b) {
  const WorldPushOf<Number> given = whole_push(c);
  give_to_a(c, given, a);
  give_to_b(c, given, b);
}

// Adds to a point's normal impulse, which never becomes a pull. Returns by how much that changed the point's speed,
// m/s.
template <typename Number>
BROADSIDE_HD Number add_normal_impulse(const PatchOf<Number>& c, PatchPointOf<Number>& p, PatchMotionOf<Number>& m,
                                       Number change) {
  const TwistOf<Number> gain = gain_by_normal(c.mobility, p.lever);
  const Number sum = p.normal_impulse + change;
  const Number next = pick(sum > 0.0F, sum, 0.0F);
  const Number done = next - p.normal_impulse;
  p.normal_impulse = next;
  m.twist = plus<Number>(m.twist, done, gain);
  m.given.add_normal(p.lever, done);
  const Number faster = done * normal_speed(gain, p.lever);
  return pick(faster < 0.0F, -faster, faster);
}

// Friction after the normal impulses: the impulse that stops the point, if static friction can give it; else kinetic
// friction against the slip. A sliding point has one mobility for both tangents, so from sweep to sweep its friction
// turns until it opposes the slip. Returns the square of the change of the point's speed, m^2/s^2, because only the
// largest change of a patch is needed.
template <typename Number>
BROADSIDE_HD Number solve_friction(const PatchOf<Number>& c, PatchPointOf<Number>& p, PatchMotionOf<Number>& m) {
  const Number v1 = tangent_1_speed(m.twist, p.lever);
  const Number v2 = tangent_2_speed(m.twist, p.lever);
  Number want_1 = less_product(less_product(p.tangent_impulse_1, p.stick_mass_11, v1), p.stick_mass_12, v2);
  Number want_2 = less_product(less_product(p.tangent_impulse_2, p.stick_mass_12, v1), p.stick_mass_22, v2);
  const Number held = pick(p.slides, c.surface.mu_kinetic, c.surface.mu_static) * p.normal_impulse;
  const TruthOf<Number> is_sliding = plus_product(want_1 * want_1, want_2, want_2) > held * held;
  if (!is_left_out(!any(is_sliding))) {
    p.slides = p.slides | is_sliding;
    const Number most = c.surface.mu_kinetic * p.normal_impulse;
    // The impulse that would stop the point, as the speed that it takes away.
    const Number slide_1 = plus_product(-v1, p.slip_mobility, p.tangent_impulse_1);
    const Number slide_2 = plus_product(-v2, p.slip_mobility, p.tangent_impulse_2);
    const Number size_squared = plus_product(slide_1 * slide_1, slide_2, slide_2);
    const Number mobility_squared = p.slip_mobility * p.slip_mobility;
    const TruthOf<Number> is_more = size_squared > mobility_squared * (most * most);
    const Number share =
        pick(is_more, most, 1.0F) * reciprocal_root<Number>(pick(is_more, size_squared, mobility_squared));
    want_1 = pick(is_sliding, share * slide_1, want_1);
    want_2 = pick(is_sliding, share * slide_2, want_2);
  }
  const Number change_1 = want_1 - p.tangent_impulse_1;
  const Number change_2 = want_2 - p.tangent_impulse_2;
  p.tangent_impulse_1 = want_1;
  p.tangent_impulse_2 = want_2;
  m.twist = plus<Number>(m.twist, change_1, gain_by_tangent_1(c.mobility, p.lever));
  m.twist = plus<Number>(m.twist, change_2, gain_by_tangent_2(c.mobility, p.lever));
  m.given.add_tangents(p.lever, change_1, change_2);
  return plus_product(change_1 * change_1, change_2, change_2) * (p.slip_mobility * p.slip_mobility);
}

// Returns the largest change of a point's speed, m/s.
template <typename Number>
BROADSIDE_HD Number solve_frictions(PatchOf<Number>& c, PatchMotionOf<Number>& m) {
  Number squared = 0.0F;
  each_point_or_zeros(c, [&](int k) {
    const Number of_point = solve_friction(c, c.points[k], m);
    squared = pick(of_point > squared, of_point, squared);
  });
  return square_root(squared);
}

// How fast the soft contact yields to the impulse that a point bears, m/s.
template <typename Number>
BROADSIDE_HD Number yielding(const PatchPointOf<Number>& p, const SoftStep& step) {
  return step.yield_scale * p.normal_impulse * near_reciprocal<Number>(p.normal_mass);
}

// The largest speed at which an overlap is pushed apart, beside the yielding of the soft contact. With gravity it is
// half of the speed that a fall through the depth would give: a body that rides on the pushed one, and keeps that
// speed, then keeps no more energy than that of a quarter of the lift.
template <typename Number>
BROADSIDE_HD Number most_push(const PatchOf<Number>& c, Number depth_m, const SoftStep& step) {
  if (!(step.gravity_m_s2 > 0.0F)) return c.fastest_push_m_s;
  return near_root<Number>(0.5F * step.gravity_m_s2 * depth_m);
}

// What a sweep wants of the points of a patch. It follows from where the bodies are and from the patch's own impulses,
// not from velocities: no other patch changes it during a sweep.
template <typename Number>
struct PatchGoalsOf {
  // The speed at which a point may approach, m/s: so fast that it closes a gap; negative where it is to be pushed
  // apart.
  Number allowed_m_s[kManifoldPoints] = {};
  // Whether the point has a gap. After the bodies moved: a gap and no impulse, so that the sweep leaves the point out.
  TruthOf<Number> is_open[kManifoldPoints] = {};
};
using PatchGoals = PatchGoalsOf<float>;

// The goals of a sweep before the bodies move. gap_m(k): the gap of point k at the start of the substep.
template <typename Number, typename Gap>
BROADSIDE_HD PatchGoalsOf<Number> goals_of(const PatchOf<Number>& c, const SoftStep& step, const Gap& gap_m) {
  PatchGoalsOf<Number> goals;
  each_point_or_zeros(c, [&](int k) {
    const PatchPointOf<Number>& p = c.points[k];
    const Number gap = gap_m(k);
    const TruthOf<Number> is_open = gap > 0.0F;
    goals.is_open[k] = is_open;
    goals.allowed_m_s[k] = gap * step.per_dt_s;  // it may close within the substep, no more
    if (!is_left_out(!any(!is_open))) {
      const Number wish = (gap + c.slop_m) * step.push_rate_per_s;
      const Number slow = pick(wish > step.settle_m_s, step.settle_m_s, wish);
      const Number fast = most_push<Number>(c, -gap, step) + yielding<Number>(p, step);
      goals.allowed_m_s[k] = pick(is_open, goals.allowed_m_s[k], pick(slow < -fast, -fast, slow));
    }
  });
  return goals;
}
template <typename Number, typename Body>
BROADSIDE_HD PatchGoalsOf<Number> goals_of(const PatchOf<Number>& c, const Body& a, const Body& b,
                                           const SoftStep& step) {
  return goals_of(c, step, gaps_now(c, a, b));
}

// One sweep over a patch before the bodies move. Returns the largest change of a point's speed, m/s.
template <typename Number, typename Body>
BROADSIDE_HD Number solve_patch(PatchOf<Number>& c, const PatchGoalsOf<Number>& goals, Body& a, Body& b,
                                const SoftStep& step) {
  PatchMotionOf<Number> m = motion_of<Number>(c, a, b);
  Number largest = 0.0F;
  each_point_or_zeros(c, [&](int k) {
    PatchPointOf<Number>& p = c.points[k];
    const Number speed = normal_speed(m.twist, p.lever);
    const Number rigid = speed + goals.allowed_m_s[k];
    const Number soft = -p.normal_mass * step.mass_scale * rigid - step.impulse_scale * p.normal_impulse;
    const Number size = add_normal_impulse<Number>(c, p, m, pick(goals.is_open[k], -p.normal_mass * rigid, soft));
    largest = pick(size > largest, size, largest);
  });
  const Number size = solve_frictions(c, m);
  store<Number>(c, m, a, b);
  return pick(size > largest, size, largest);
}

// Whether the point approached fast, and touches in this substep for the first time.
template <typename Number>
BROADSIDE_HD TruthOf<Number> bounces(const PatchOf<Number>& c, const PatchPointOf<Number>& p) {
  const TruthOf<Number> is_met = p.normal_impulse > 0.0F;
  return may_bounce(c, p) & is_met;
}

// The goals of a sweep after the bodies moved. Computes the patch's masses again where its bodies have turned far:
// bodies turn only when they move, so these masses hold until they move again. Impulses count as given also where a
// step along a conjugate direction left them below 0, and where they were taken back (go_back_to).
template <typename Number, typename Body>
BROADSIDE_HD PatchGoalsOf<Number> goals_after_motion(PatchOf<Number>& c, const Body& a, const Body& b,
                                                     const SoftStep& step) {
  const TruthOf<Number> is_far_a = has_turned_far(a);
  const TruthOf<Number> is_far_b = has_turned_far(b);
  const TruthOf<Number> is_far = is_far_a | is_far_b;
  if (any(is_far)) set_mobility_where<Number>(is_far, c, a, b);
  PatchGoalsOf<Number> goals;
  const auto gaps = gaps_now(c, a, b);
  each_point_or_zeros(c, [&](int k) {
    const PatchPointOf<Number>& p = c.points[k];
    const Number gap = gaps(k);
    const TruthOf<Number> has_gap = gap > 0.0F;
    const TruthOf<Number> has_pushed = (p.normal_impulse > 0.0F) | has_sign(p.normal_impulse);
    const TruthOf<Number> is_bouncing = bounces(c, p);
    // An open point that gave no impulse is left to the next substep.
    goals.is_open[k] = has_gap & !has_pushed;
    // A point that bounces has touched, wherever its neighbors have moved it since.
    goals.allowed_m_s[k] = pick(has_gap & !is_bouncing, gap * step.per_dt_s, 0.0F);
  });
  return goals;
}

// One sweep over a patch after the bodies moved: closed points neither close nor open. Returns the largest change of a
// point's speed, m/s.
template <typename Number, typename Body>
BROADSIDE_HD Number relax_patch(PatchOf<Number>& c, const PatchGoalsOf<Number>& goals, Body& a, Body& b) {
  PatchMotionOf<Number> m = motion_of<Number>(c, a, b);
  Number largest = 0.0F;
  each_point_or_zeros(c, [&](int k) {
    const TruthOf<Number> is_met = !goals.is_open[k];
    if (is_left_out(!any(is_met))) return;
    PatchPointOf<Number>& p = c.points[k];
    const Number speed = normal_speed(m.twist, p.lever);
    const Number wish = -p.normal_mass * (speed + goals.allowed_m_s[k]);
    // An open point has no impulse, and gets none.
    const Number size = add_normal_impulse<Number>(c, p, m, pick(is_met, wish, 0.0F));
    largest = pick(size > largest, size, largest);
  });
  const Number size = solve_frictions(c, m);
  store<Number>(c, m, a, b);
  return pick(size > largest, size, largest);
}

// The fastest approach of the patch's points that bounce, m/s; 0 = none does.
BROADSIDE_HD float fastest_bounce(const PatchOf<float>& c) {
  float fastest = 0.0F;
  each_point(c, [&](int k) {
    if (bounces(c, c.points[k]) && c.points[k].approach_m_s > fastest) fastest = c.points[k].approach_m_s;
  });
  return fastest;
}

// The most sweeps over the points of one patch in a visit, forward and backward in turns: the points share both bodies,
// and one sweep would leave a spin toward the last point. For the four corners of a cube, less than a thousandth is
// left after these. Most patches are done sooner: a patch of one point after one pass, and all patches once the sweeps
// over all of them change little.
inline constexpr int kSweepsOfBounce = 8;

// Sweeps over all patches end where one changes no speed by more than this share of the fastest approach.
inline constexpr float kBounceDone = 0x1p-10F;

// Before a bounce: the sum of the impulses that the points that bounce may give, which is the restitution times the
// impulse that stopped them. How the points share this sum is often undetermined.
BROADSIDE_HD void note_budget(PatchConstraint& c) {
  float stopped = 0.0F;
  each_point(c, [&](int k) {
    const PatchPoint& p = c.points[k];
    if (bounces(c, p)) stopped += p.normal_impulse;
  });
  c.budget_n_s = c.surface.restitution * stopped;
}

// Points that approached fast leave with that speed times the restitution (Newton's rule), but get at most the
// restitution times the impulse that stopped their patch (Poisson's rule): where friction turns a body about its
// corner, Newton's rule alone may give back more energy than stopping took (Kane and Levinson, Dynamics, 1985). Returns
// the largest change of a point's speed, m/s. done_m_s: the sweeps over its points end when none changes a speed by
// more than this.
BROADSIDE_HD float bounce(PatchConstraint& c, SolverBody& a, SolverBody& b, float done_m_s) {
  PatchMotion m = motion_of<float>(c, a, b);
  float largest = 0.0F;
  float changed = 0.0F;  // of the last two sweeps over the patch
  const auto visit = [&](int k) {
    PatchPoint& p = c.points[k];
    if (!bounces(c, p)) return;
    const float speed = normal_speed(m.twist, p.lever);
    const float wish = p.normal_mass * (c.surface.restitution * p.approach_m_s - speed);
    const float before = p.normal_impulse;
    const float size = add_normal_impulse<float>(c, p, m, wish < c.budget_n_s ? wish : c.budget_n_s);
    c.budget_n_s -= p.normal_impulse - before;
    largest = size > largest ? size : largest;
    changed = size > changed ? size : changed;
  };
#if defined(__CUDACC__)
#pragma unroll 1  // unrolled, the loop is too much code for a GPU's instruction cache
#endif
  for (int k = 0; k < kSweepsOfBounce; k += 2) {
    changed = 0.0F;
    each_point(c, visit);
    each_point_back(c, visit);
    if (!(changed > done_m_s)) break;
  }
  const float size = solve_frictions(c, m);
  store<float>(c, m, a, b);
  return size > largest ? size : largest;
}

// Ends a substep. Points that bounced leave, so the next substep does not begin with the impulse of their impact.
template <typename Number>
BROADSIDE_HD void drop_impacts(PatchOf<Number>& c) {
  each_point(c, [&](int k) {
    PatchPointOf<Number>& p = c.points[k];
    const TruthOf<Number> leaves = bounces(c, p);
    p.normal_total = pick(leaves, p.normal_total + p.normal_impulse, p.normal_total);
    p.tangent_total_1 = pick(leaves, p.tangent_total_1 + p.tangent_impulse_1, p.tangent_total_1);
    p.tangent_total_2 = pick(leaves, p.tangent_total_2 + p.tangent_impulse_2, p.tangent_total_2);
    p.normal_impulse = pick(leaves, 0.0F, p.normal_impulse);
    p.tangent_impulse_1 = pick(leaves, 0.0F, p.tangent_impulse_1);
    p.tangent_impulse_2 = pick(leaves, 0.0F, p.tangent_impulse_2);
  });
}

template <typename Number>
BROADSIDE_HD void add_to_totals(PatchOf<Number>& c) {
  each_point_or_zeros(c, [&](int k) {
    PatchPointOf<Number>& p = c.points[k];
    p.normal_total = p.normal_total + p.normal_impulse;
    p.tangent_total_1 = p.tangent_total_1 + p.tangent_impulse_1;
    p.tangent_total_2 = p.tangent_total_2 + p.tangent_impulse_2;
  });
}

}  // namespace broadside::core
