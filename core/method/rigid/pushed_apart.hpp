// Patches that overlap by more than their load explains are pushed apart within a substep. The push moves their bodies,
// but must not stay as speed. So once the bodies have moved, these patches return to the impulses that the substep
// began with, and the bodies to the velocities that follow from these. If nothing else happened, nothing of the push is
// left, to the last bit; otherwise relaxation solves for the rest.
//
// Before, one sweep of relaxation took back the push, and such a sweep takes back only what a single contact sees of
// it: ten cubes at rest in a row, each 4 cm deep in the next, parted with 8.1 J. Pushes are taken back in calm steps,
// and without gravity. In other steps, keeping the push and going on from there takes fewer sweeps
// (SoftSettings::even).
#pragma once

#include <cstdint>
#include <limits>

#include "core/attributes.hpp"
#include "core/math/lane_number.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"

namespace broadside::core {

// Sweeps of relaxation visit patches that were pushed, and patches that these sweeps change. They end with one that
// changes no speed by more than this share of the fastest push.
inline constexpr float kRelaxDone = 0x1p-10F;

BROADSIDE_HD constexpr float relax_done_m_s(const SoftStep& step, float fastest_push_m_s) {
  const float done = done_m_s(step, kRelaxDone, fastest_push_m_s);
  return done > step.least_relax_m_s ? done : step.least_relax_m_s;
}

// The largest speed at which a point of a patch is pushed, m/s, beyond twice what its spring yields to the impulse that
// the substep begins with; 0 if none is. Twice, because where a light body bears a heavy one, the load is known only to
// within a few percent, and taking back a part of the load makes the body sway. gap_m(k): the gap of point k at the
// start of the substep.
template <typename Number, typename Gap>
BROADSIDE_HD Number fastest_push(const PatchOf<Number>& c, const SoftStep& step, const Gap& gap_m) {
  Number fastest = 0.0F;
  each_point_or_zeros(c, [&](int k) {
    const Number gap = gap_m(k);
    const TruthOf<Number> is_closed = (gap < 0.0F) & TruthOf<Number>(k < c.count);
    if (is_left_out(!any(is_closed))) return;
    const Number wish = (gap + c.slop_m) * step.push_rate_per_s;
    const Number beside = (0.0F - wish) - 2.0F * yielding<Number>(c.points[k], step);
    const Number most = most_push<Number>(c, 0.0F - gap, step);
    const Number push = pick(beside > most, most, beside);
    fastest = pick(is_closed & (push > fastest), push, fastest);
  });
  return fastest;
}

BROADSIDE_HD constexpr bool takes_back_pushes(const SoftStep& step) {
  return step.kept_push_m_s < std::numeric_limits<float>::max();
}

// Whether the push of a patch is taken back. Without gravity nothing says which push is small, and the effect of pushes
// on other bodies must vanish, too. So if one patch is pushed, all patches go back to their earlier impulses.
BROADSIDE_HD constexpr bool is_taken_back(float push_m_s, const SoftStep& step) {
  return push_m_s > step.kept_push_m_s || !(step.gravity_m_s2 > 0.0F);
}

// Normal and tangents, of each point.
struct PatchImpulsesBefore {
  float of[kManifoldPoints][3] = {};
};

BROADSIDE_HD PatchImpulsesBefore impulses_before(const PatchConstraint& c) {
  PatchImpulsesBefore before;
  each_point(c, [&](int k) {
    before.of[k][0] = c.points[k].normal_impulse;
    before.of[k][1] = c.points[k].tangent_impulse_1;
    before.of[k][2] = c.points[k].tangent_impulse_2;
  });
  return before;
}

// The normal impulse of a point that was met within the substep, after its impulse is taken back. It is zero to every
// sum, and its sign tells relaxation that the point was met: the bodies moved as if it had been solved, so a gap that
// rounding or an arc left must not make it wait for the next substep. Before, where something was pushed in every
// substep, a body turned along a wall that it struck, for fifteen steps, and never bounced. Relaxation, which visits
// every such point, leaves no -0.
inline constexpr float kTakenBack = -0.0F;

BROADSIDE_HD void go_back_to(const PatchImpulsesBefore& before, PatchConstraint& c) {
  each_point(c, [&](int k) {
    const bool is_met = c.points[k].normal_impulse > 0.0F;
    c.points[k].normal_impulse = is_met && before.of[k][0] == 0.0F ? kTakenBack : before.of[k][0];
    c.points[k].tangent_impulse_1 = before.of[k][1];
    c.points[k].tangent_impulse_2 = before.of[k][2];
  });
}

}  // namespace broadside::core
