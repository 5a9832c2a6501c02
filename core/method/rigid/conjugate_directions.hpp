// Sweeps over contacts go on along conjugate directions: Silcowitz, Niebe and Erleben, A nonsmooth nonlinear conjugate
// gradient method for interactive contact force problems (2010), with the rule of Fletcher and Reeves. RIGID 8.5.
//
// One sweep carries an impulse from one contact to the next. A stack of n bodies takes some n^2 sweeps, and a mass n
// times that of its support takes some n. Along conjugate directions the number of sweeps is the square root of that.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

// Impulses of a patch in the direction of the last sweeps.
template <typename Number>
struct PatchWayOf {
  Number before[kManifoldPoints][3];  // impulses before the sweep: normal and tangents
  Number way[kManifoldPoints][3];     // the direction
};
using PatchWay = PatchWayOf<float>;

template <typename Number>
BROADSIDE_HD void note_impulses(const PatchOf<Number>& c, PatchWayOf<Number>& way) {
  each_point(c, [&](int k) {
    way.before[k][0] = c.points[k].normal_impulse;
    way.before[k][1] = c.points[k].tangent_impulse_1;
    way.before[k][2] = c.points[k].tangent_impulse_2;
  });
}

// The squared size of what the sweep changed, weighted with the mobilities of the points, J.
template <typename Number>
BROADSIDE_HD Number squared_change(const PatchOf<Number>& c, const PatchWayOf<Number>& way) {
  Number sum = 0.0F;
  each_point(c, [&](int k) {
    const PatchPointOf<Number>& p = c.points[k];
    const Number n = p.normal_impulse - way.before[k][0];
    const Number t1 = p.tangent_impulse_1 - way.before[k][1];
    const Number t2 = p.tangent_impulse_2 - way.before[k][2];
    sum = sum + ((n * n + t1 * t1) + t2 * t2) / p.normal_mass;
  });
  return sum;
}

// How much of the last direction is added (Fletcher and Reeves). The arguments are the squared changes of the first
// sweep of a substep, of the last one and of this one; 0 where there was none. The answer is 0, which restarts the
// directions, where changes grow or are larger than at first: with friction a sweep need not lower an energy, and
// without restarts a direction might be followed without end.
BROADSIDE_HD constexpr float share_of_direction(float first_change, float last_change, float change) {
  return last_change > 0.0F && change <= last_change && change <= first_change ? change / last_change : 0.0F;
}

// The shares of directions in one run of sweeps.
class DirectionShare {
 public:
  // The share that follows a sweep. change: the sum of squared_change over all patches.
  BROADSIDE_HD constexpr float after(float change) {
    if (!(last_change_ > 0.0F)) first_change_ = change;
    const float share = share_of_direction(first_change_, last_change_, change);
    last_change_ = change;
    return share;
  }

 private:
  float first_change_ = 0.0F;
  float last_change_ = 0.0F;
};

// Whether sweeps alternate with steps along directions. Where only one sweep holds the bodies, none do, not even those
// of a bounce.
BROADSIDE_HD constexpr bool has_directions(const SoftStep& step) {
  return step.most_sweeps > 1;
}

// How far a step along the last direction changes a point's impulses.
template <typename Number>
struct PointStep {
  Number normal = 0.0F;
  Number tangent_1 = 0.0F;
  Number tangent_2 = 0.0F;
};

template <typename Number>
BROADSIDE_HD PointStep<Number> step_along(const Number (&way)[3], float share) {
  return {share * way[0], share * way[1], share * way[2]};
}

// Goes on along the last direction by `share` of it, and adds to the direction what the sweep changed. This changes
// impulses alone; push_along changes the bodies.
template <typename Number>
BROADSIDE_HD void follow_impulses(PatchOf<Number>& c, PatchWayOf<Number>& way, float share) {
  each_point(c, [&](int k) {
    PatchPointOf<Number>& p = c.points[k];
    const Number changed[3] = {p.normal_impulse - way.before[k][0], p.tangent_impulse_1 - way.before[k][1],
                               p.tangent_impulse_2 - way.before[k][2]};
    const PointStep<Number> more = step_along(way.way[k], share);
    way.way[k][0] = more.normal + changed[0];
    way.way[k][1] = more.tangent_1 + changed[1];
    way.way[k][2] = more.tangent_2 + changed[2];
    p.normal_impulse = p.normal_impulse + more.normal;
    p.tangent_impulse_1 = p.tangent_impulse_1 + more.tangent_1;
    p.tangent_impulse_2 = p.tangent_impulse_2 + more.tangent_2;
  });
}

// What the step along the direction does to the bodies. Call it before follow_impulses, which changes the direction.
template <typename Number, typename Body>
BROADSIDE_HD void push_along(const PatchOf<Number>& c, const PatchWayOf<Number>& way, Body& a, Body& b, float share) {
  PatchPushOf<Number> along;
  each_point(c, [&](int k) {
    const PointStep<Number> more = step_along(way.way[k], share);
    along.add_normal(c.points[k].lever, more.normal);
    along.add_tangents(c.points[k].lever, more.tangent_1, more.tangent_2);
  });
  const WorldPushOf<Number> given = in_world(c, along);
  give_to_a(c, given, a);
  give_to_b(c, given, b);
}

}  // namespace broadside::core
