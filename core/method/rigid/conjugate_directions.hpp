// Sweeps over contacts go on along conjugate directions: Silcowitz, Niebe and Erleben, A nonsmooth nonlinear conjugate
// gradient method for interactive contact force problems (2010), with the rule of Fletcher and Reeves. RIGID 8.5.
//
// A sweep alone carries an impulse from one contact to the next; a stack of n bodies, or a mass n times its support,
// takes some n^2 or n of them. Along conjugate directions it takes the square root of that.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

// Impulses of a patch in the direction of the last sweeps.
struct PatchWay {
  float before[kManifoldPoints][3];  // impulses before the sweep: normal and tangents
  float way[kManifoldPoints][3];     // the direction
};

BROADSIDE_HD void note_impulses(const PatchConstraint& c, PatchWay& way) {
  for (int k = 0; k < c.count; ++k) {
    way.before[k][0] = c.points[k].normal_impulse;
    way.before[k][1] = c.points[k].tangent_impulse_1;
    way.before[k][2] = c.points[k].tangent_impulse_2;
  }
}

// The square of what the sweep changed, in the mobilities of the points, J.
BROADSIDE_HD float squared_change(const PatchConstraint& c, const PatchWay& way) {
  float sum = 0.0F;
  for (int k = 0; k < c.count; ++k) {
    const PatchPoint& p = c.points[k];
    const float n = p.normal_impulse - way.before[k][0];
    const float t1 = p.tangent_impulse_1 - way.before[k][1];
    const float t2 = p.tangent_impulse_2 - way.before[k][2];
    sum += ((n * n + t1 * t1) + t2 * t2) / p.normal_mass;
  }
  return sum;
}

// How much of the last direction is added, by the squared changes of the first sweep of a substep, the one before and
// this one; those that were not yet are 0. None where changes grow, nor where they are larger than at first: friction
// makes sweeps that do not shrink an energy, and directions may then lead on and on.
BROADSIDE_HD constexpr float share_of_direction(float first_change, float last_change, float change) {
  return last_change > 0.0F && change <= last_change && change <= first_change ? change / last_change : 0.0F;
}

// Goes on along the last direction by `share` of it, and turns the direction to what the sweep changed.
BROADSIDE_HD void follow(PatchConstraint& c, PatchWay& way, SolverBody& a, SolverBody& b, float share) {
  PatchMotion m = motion_of(a, b);
  for (int k = 0; k < c.count; ++k) {
    PatchPoint& p = c.points[k];
    const float step[3] = {p.normal_impulse - way.before[k][0], p.tangent_impulse_1 - way.before[k][1],
                           p.tangent_impulse_2 - way.before[k][2]};
    float more[3];
    for (int i = 0; i < 3; ++i) {
      more[i] = share * way.way[k][i];
      way.way[k][i] = more[i] + step[i];
    }
    p.normal_impulse += more[0];
    p.tangent_impulse_1 += more[1];
    p.tangent_impulse_2 += more[2];
    push(m, a, b, p, (more[0] * c.normal + more[1] * c.tangent_1) + more[2] * c.tangent_2);
  }
  store(m, a, b);
}

}  // namespace broadside::core
