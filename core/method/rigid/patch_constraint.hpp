// One patch of contact as a solver keeps it through a step: at most four points of one normal, the impulses of the
// current substep and their totals. RIGID 8.5.
//
// Number is float, or several floats side by side: then a constraint stands for as many patches, which share no moved
// body.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "core/attributes.hpp"
#include "core/material.hpp"
#include "core/math/fused.hpp"
#include "core/math/lane_number.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/each_point.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/patch_twist.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

template <typename Number>
struct PatchPointOf {
  // From the patch's center to the point, in the patch's axes, at the start of the step. It stays through the step: an
  // impulse's moment is then that of the recorded point, and both bodies together gain none.
  VectorOf<Number> lever;
  Number gap_m = 0.0F;        // at the start of the step
  Number normal_mass = 0.0F;  // kg: impulse along the normal per change of speed along it
  // Of the tangent plane: the inverse of the mobility, symmetric 2 x 2, and the larger eigenvalue of the mobility,
  // 1/kg.
  Number stick_mass_11 = 0.0F;
  Number stick_mass_12 = 0.0F;
  Number stick_mass_22 = 0.0F;
  Number slip_mobility = 0.0F;
  // Of the current substep, N s on A.
  Number normal_impulse = 0.0F;
  Number tangent_impulse_1 = 0.0F;
  Number tangent_impulse_2 = 0.0F;
  // Of all substeps that are over.
  Number normal_total = 0.0F;
  Number tangent_total_1 = 0.0F;
  Number tangent_total_2 = 0.0F;
  Number approach_m_s = 0.0F;      // at the start of the step, positive where the bodies come nearer
  TruthOf<Number> slides = false;  // in this substep, since static friction first did not hold it
};
using PatchPoint = PatchPointOf<float>;

// A material of several patches side by side.
template <typename Lanes>
struct LaneMaterial {
  Lanes mu_static = 0.0F;
  Lanes mu_kinetic = 0.0F;
  Lanes restitution = 0.0F;
};

template <typename Number>
struct PatchOf {
  VectorOf<Number> normal;  // unit, from B to A
  VectorOf<Number> tangent_1;
  VectorOf<Number> tangent_2;
  // From each body's center of mass to the patch's center, which is the middle of its points, at the start of the step.
  VectorOf<Number> center_a;
  VectorOf<Number> center_b;
  TwistMobilityOf<Number> mobility;
  std::conditional_t<std::is_same_v<Number, float>, Material, LaneMaterial<Number>> surface;  // of both, combined
  Number slop_m = 0.0F;            // the depth at which the patch rests
  Number fastest_push_m_s = 0.0F;  // the largest speed of pushing an overlap apart, where there is no gravity
  Number budget_n_s = 0.0F;        // of normal impulses that a bounce may still give
  int count = 0;
  PatchPointOf<Number> points[kManifoldPoints];
};

struct PatchConstraint : PatchOf<float> {
  std::uint32_t a = 0;  // indices of solver bodies
  std::uint32_t b = 0;
};

// From the patch's axes to the world, and back.
template <typename Number>
BROADSIDE_HD VectorOf<Number> in_world(const PatchOf<Number>& c, Number along_normal, Number along_1, Number along_2) {
  return plus_times(plus_times<VectorOf<Number>>(along_normal * c.normal, along_1, c.tangent_1), along_2, c.tangent_2);
}
template <typename Number, typename Vector>
BROADSIDE_HD Vector in_patch(const PatchOf<Number>& c, const Vector& v) {
  return {fused_dot(c.normal, v), fused_dot(c.tangent_1, v), fused_dot(c.tangent_2, v)};
}

// From the centers of mass to a point, world axes.
template <typename Number>
BROADSIDE_HD VectorOf<Number> arm_a(const PatchOf<Number>& c, const PatchPointOf<Number>& p) {
  return c.center_a + in_world<Number>(c, p.lever.x, p.lever.y, p.lever.z);
}
template <typename Number>
BROADSIDE_HD VectorOf<Number> arm_b(const PatchOf<Number>& c, const PatchPointOf<Number>& p) {
  return c.center_b + in_world<Number>(c, p.lever.x, p.lever.y, p.lever.z);
}

// The distance of the patch's farthest point from the center of mass of its body, m: the smaller of both distances, of
// bodies that can move. Lengths of the patch that should be small, such as the slop, are shares of it.
BROADSIDE_HD float reach_of(const PatchConstraint& c, const SolverBody& a, const SolverBody& b) {
  float of_a = 0.0F;
  float of_b = 0.0F;
  each_point(c, [&](int k) {
    const Vec3 from_a = arm_a(c, c.points[k]);
    const Vec3 from_b = arm_b(c, c.points[k]);
    of_a = dot(from_a, from_a) > of_a ? dot(from_a, from_a) : of_a;
    of_b = dot(from_b, from_b) > of_b ? dot(from_b, from_b) : of_b;
  });
  if (!is_moved(a)) return sqrtf(of_b);
  if (!is_moved(b)) return sqrtf(of_a);
  return sqrtf(of_a < of_b ? of_a : of_b);
}

template <typename Number, typename Body>
BROADSIDE_HD TwistMobilityOf<Number> mobility_of(const PatchOf<Number>& c, const Body& a, const Body& b) {
  TwistMobilityOf<Number> m;
  add_mobility(m, a, c.normal, c.tangent_1, c.tangent_2, c.center_a);
  add_mobility(m, b, c.normal, c.tangent_1, c.tangent_2, c.center_b);
  return m;
}

// The effective masses: how much impulse changes a point's speed by 1 m/s.
template <typename Number>
BROADSIDE_HD void set_masses(const TwistMobilityOf<Number>& m, PatchPointOf<Number>& p) {
  const TwistOf<Number> by_1 = gain_by_tangent_1(m, p.lever);
  const TwistOf<Number> by_2 = gain_by_tangent_2(m, p.lever);
  p.normal_mass = 1.0F / normal_speed(gain_by_normal(m, p.lever), p.lever);
  const Number k11 = tangent_1_speed(by_1, p.lever);
  const Number k22 = tangent_2_speed(by_2, p.lever);
  const Number k12 = tangent_1_speed(by_2, p.lever);
  // In every direction the mobility is at least the sum of the inverse masses, so its determinant is positive.
  const Number inverse = 1.0F / (k11 * k22 - k12 * k12);
  p.stick_mass_11 = inverse * k22;
  p.stick_mass_22 = inverse * k11;
  p.stick_mass_12 = -inverse * k12;
  const Number half = 0.5F * (k11 - k22);
  p.slip_mobility = 0.5F * (k11 + k22) + square_root(half * half + k12 * k12);
}

// The mobility of the patch, and the masses of its points, as its bodies are turned now.
template <typename Number, typename Body>
BROADSIDE_HD void set_mobility(PatchOf<Number>& c, const Body& a, const Body& b) {
  c.mobility = mobility_of(c, a, b);
  each_point(c, [&](int k) { set_masses(c.mobility, c.points[k]); });
}

// The same, only in lanes where is_asked.
template <typename Number, typename Body>
BROADSIDE_HD void set_mobility_where(TruthOf<Number> is_asked, PatchOf<Number>& c, const Body& a, const Body& b) {
  const TwistMobilityOf<Number> now = mobility_of(c, a, b);
  const auto choose = [&](Number& kept, const Number& other) { kept = pick(is_asked, other, kept); };
  each_of_mobilities(c.mobility, now, choose);
  each_point(c, [&](int k) {
    PatchPointOf<Number> of_now = c.points[k];
    set_masses(now, of_now);
    choose(c.points[k].normal_mass, of_now.normal_mass);
    choose(c.points[k].stick_mass_11, of_now.stick_mass_11);
    choose(c.points[k].stick_mass_12, of_now.stick_mass_12);
    choose(c.points[k].stick_mass_22, of_now.stick_mass_22);
    choose(c.points[k].slip_mobility, of_now.slip_mobility);
  });
}

// Whether a body has turned so far in the step, in rad, that the effective masses of the start no longer hold. When a
// slender body turns across its axis, the effective mass at a point may fall by the ratio of its length to its
// thickness, and a sweep does not converge with masses that are twice too large. Before, a needle that struck a plate
// at 100 m/s ended with numbers that are not finite.
template <typename Body>
BROADSIDE_HD auto has_turned_far(const Body& body) {
  constexpr float kFar_rad = 0x1p-8F;
  return dot(body.turned, body.turned) > kFar_rad * kFar_rad;
}

// center_b_from_a: from A's center of mass to B's, at the start of the step; not used where B is a face or static.
BROADSIDE_HD PatchConstraint make_constraint(const Manifold& manifold, const SolverBody& a, const SolverBody& b,
                                             Vec3 center_b_from_a, const Material& surface) {
  PatchConstraint c;
  c.normal = manifold.normal;
  c.tangent_1 = unit_across(c.normal);
  c.tangent_2 = cross(c.normal, c.tangent_1);
  c.surface = surface;
  c.count = manifold.count;
  Vec3 sum;
  each_point(c, [&](int k) { sum = sum + manifold.points[k].point; });
  c.center_a = (1.0F / static_cast<float>(c.count)) * sum;
  c.center_b = c.center_a - center_b_from_a;
  each_point(c, [&](int k) {
    PatchPoint& p = c.points[k];
    p.lever = in_patch(c, manifold.points[k].point - c.center_a);
    p.gap_m = manifold.points[k].gap_m;
  });
  set_mobility(c, a, b);
  return c;
}

// The sum of impulses on A at points of a patch, and of their moments about the patch's center, in the patch's axes.
template <typename Number>
struct PatchPushOf {
  VectorOf<Number> push;    // N s
  VectorOf<Number> moment;  // N m s

  BROADSIDE_HD void add_normal(const VectorOf<Number>& lever, Number normal) {
    push.x = push.x + normal;
    moment.y = plus_product(moment.y, lever.z, normal);
    moment.z = less_product(moment.z, lever.y, normal);
  }
  BROADSIDE_HD void add_tangents(const VectorOf<Number>& lever, Number tangent_1, Number tangent_2) {
    push.y = push.y + tangent_1;
    push.z = push.z + tangent_2;
    moment.x = less_product(plus_product(moment.x, lever.y, tangent_2), lever.z, tangent_1);
    moment.y = less_product(moment.y, lever.x, tangent_2);
    moment.z = plus_product(moment.z, lever.x, tangent_1);
  }
};

// Static bodies are shared by patches of one color, so they are never written.
template <typename Body>
BROADSIDE_HD void store(Body& body, const VectorOf<typename Body::Number>& v,
                        const VectorOf<typename Body::Number>& gain) {
  if (!any(is_moved(body))) return;
  body.v = pick(is_moved(body), v, body.v);
  body.angular_momentum = pick(is_moved(body), body.angular_momentum + gain, body.angular_momentum);
}

// A sum of impulses and of their moments, in world axes.
template <typename Number>
struct WorldPushOf {
  VectorOf<Number> impulse;
  VectorOf<Number> moment;
};
template <typename Number>
BROADSIDE_HD WorldPushOf<Number> in_world(const PatchOf<Number>& c, const PatchPushOf<Number>& given) {
  // Plus 0, so that a sum that underflows is 0 and not -0, whatever zeros were added after it.
  const VectorOf<Number> none;
  const VectorOf<Number> push = none + given.push;
  const VectorOf<Number> moment = none + given.moment;
  return {in_world<Number>(c, push.x, push.y, push.z), in_world<Number>(c, moment.x, moment.y, moment.z)};
}

// Gives such impulses to each body.
template <typename Number, typename Body>
BROADSIDE_HD void give_to_a(const PatchOf<Number>& c, const WorldPushOf<Number>& given, Body& a) {
  store(a, plus_times(a.v, a.inverse_mass, given.impulse), plus_cross(given.moment, c.center_a, given.impulse));
}
template <typename Number, typename Body>
BROADSIDE_HD void give_to_b(const PatchOf<Number>& c, const WorldPushOf<Number>& given, Body& b) {
  const VectorOf<Number> none;
  store(b, less_times(b.v, b.inverse_mass, given.impulse), none - plus_cross(given.moment, c.center_b, given.impulse));
}

// The two bodies of a patch while it is solved: their relative motion, and the impulses that they got so far.
template <typename Number>
struct PatchMotionOf {
  TwistOf<Number> twist;
  PatchPushOf<Number> given;
};
using PatchMotion = PatchMotionOf<float>;

// The relative motion by velocities in world axes.
template <typename Number, typename Vector>
BROADSIDE_HD PatchMotionOf<Number> motion_of(const PatchOf<Number>& c, const Vector& v_a, const Vector& w_a,
                                             const Vector& v_b, const Vector& w_b) {
  const Vector speed = plus_cross(v_a, w_a, c.center_a) - plus_cross(v_b, w_b, c.center_b);
  // Plus 0, so that no number is -0; adding to them makes none -0 either.
  const Vector none;
  return {{none + in_patch(c, speed), none + in_patch(c, w_a - w_b)}, {}};
}
template <typename Number, typename Body>
BROADSIDE_HD PatchMotionOf<Number> motion_of(const PatchOf<Number>& c, const Body& a, const Body& b) {
  return motion_of(c, a.v, fused_product(a.inverse_inertia, a.angular_momentum), b.v,
                   fused_product(b.inverse_inertia, b.angular_momentum));
}

template <typename Number, typename Body>
BROADSIDE_HD void store(const PatchOf<Number>& c, const PatchMotionOf<Number>& m, Body& a, Body& b) {
  const WorldPushOf<Number> given = in_world(c, m.given);
  give_to_a(c, given, a);
  give_to_b(c, given, b);
}

// The impulse on A, N s, of what acts along the normal and the tangents.
template <typename Number>
BROADSIDE_HD VectorOf<Number> impulse_of(const PatchOf<Number>& c, Number normal, Number tangent_1, Number tangent_2) {
  return in_world<Number>(c, normal, tangent_1, tangent_2);
}

// How far the end of an arm went while its body turned by this vector, rad. Sine and 1 - cosine come from their series,
// which are off by a hundredth at 2.4 rad and are not used beyond. Below a thousandth of a radian the first order is
// enough. Before, all arcs were followed to first order, so a corner that swung past the lowest point of its circle
// went on downward: small cubes that spin under heavy ones were pushed into the floor, and came out of it with energy.
template <typename Vector>
BROADSIDE_HD auto swings_far(const Vector& turned) {
  return dot(turned, turned) > 0x1p-20F;
}
template <typename Vector>
BROADSIDE_HD Vector swung(const Vector& turned, const Vector& arm) {
  const Vector first = cross(turned, arm);
  const auto squared = dot(turned, turned);
  const auto is_far = swings_far(turned);
  if (!any(is_far)) return first;
  const auto s = pick(squared < 6.0F, squared, 6.0F);
  const auto sine = 1.0F - s * (1.0F / 6.0F - s * (1.0F / 120.0F - s * (1.0F / 5040.0F)));
  const auto versine = 0.5F - s * (1.0F / 24.0F - s * (1.0F / 720.0F - s * (1.0F / 40320.0F)));
  return pick(is_far, sine * first + versine * cross(turned, first), first);
}

// The present gaps of a patch's points: those of the start, and how far the bodies have moved along the normal since.
template <typename Number, typename Body>
class PatchGaps {
 public:
  BROADSIDE_HD PatchGaps(const PatchOf<Number>& c, const Body& a, const Body& b) : c_(c), a_(a), b_(b) {
    const TruthOf<Number> is_far_a = swings_far(a.turned);
    const TruthOf<Number> is_far_b = swings_far(b.turned);
    is_far_ = is_far_a | is_far_b;
    const VectorOf<Number> moved =
        plus_cross(a.moved, a.turned, c.center_a) - plus_cross(b.moved, b.turned, c.center_b);
    const VectorOf<Number> turned = a.turned - b.turned;
    moved_ = fused_dot(c.normal, moved);
    turned_1_ = fused_dot(c.tangent_1, turned);
    turned_2_ = fused_dot(c.tangent_2, turned);
  }

  // The gap of point k. It is followed to first order in the patch's axes, like the point's speeds, and along the arcs
  // where a body turned far.
  BROADSIDE_HD Number operator()(int k) const {
    const PatchPointOf<Number>& p = c_.points[k];
    const Number near = p.gap_m + less_product(plus_product(moved_, turned_1_, p.lever.z), turned_2_, p.lever.y);
    if (!any(is_far_)) return near;
    const VectorOf<Number> moved_a = a_.moved + swung(a_.turned, arm_a(c_, p));
    const VectorOf<Number> moved_b = b_.moved + swung(b_.turned, arm_b(c_, p));
    return pick(is_far_, p.gap_m + dot(c_.normal, moved_a - moved_b), near);
  }

 private:
  const PatchOf<Number>& c_;
  const Body& a_;
  const Body& b_;
  TruthOf<Number> is_far_;
  Number moved_ = 0.0F;
  Number turned_1_ = 0.0F;
  Number turned_2_ = 0.0F;
};
template <typename Number, typename Body>
BROADSIDE_HD PatchGaps<Number, Body> gaps_now(const PatchOf<Number>& c, const Body& a, const Body& b) {
  return {c, a, b};
}

// N s on A, of the whole step.
BROADSIDE_HD Vec3 total_impulse(const PatchConstraint& c, const PatchPoint& p) {
  return impulse_of(c, p.normal_total, p.tangent_total_1, p.tangent_total_2);
}

}  // namespace broadside::core
