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
#include "core/math/lane_number.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

template <typename Number>
struct PatchPointOf {
  // From each center of mass to the point, at the start of the step. They stay through the step: an impulse's moment is
  // then that of the recorded point, and both bodies together gain none.
  VectorOf<Number> arm_a;
  VectorOf<Number> arm_b;
  Number gap_m = 0.0F;        // at the start of the step
  Number normal_mass = 0.0F;  // kg: impulse along the normal per change of speed along it
  // Of the tangent plane: the inverse of the mobility, symmetric 2 x 2, and that of its larger eigenvalue.
  Number stick_mass_11 = 0.0F;
  Number stick_mass_12 = 0.0F;
  Number stick_mass_22 = 0.0F;
  Number slide_mass = 0.0F;
  // Of the current substep, N s on A.
  Number normal_impulse = 0.0F;
  Number tangent_impulse_1 = 0.0F;
  Number tangent_impulse_2 = 0.0F;
  // Of all substeps that are over.
  Number normal_total = 0.0F;
  Number tangent_total_1 = 0.0F;
  Number tangent_total_2 = 0.0F;
  Number most_impulse = 0.0F;      // normal, of the substep, up to which a bounce may push, N s
  Number approach_m_s = 0.0F;      // at the start of the step, positive where the bodies come nearer
  TruthOf<Number> slides = false;  // in this substep, from when static friction did not hold it
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
  std::conditional_t<std::is_same_v<Number, float>, Material, LaneMaterial<Number>> surface;  // of both, combined
  Number slop_m = 0.0F;            // the depth at which the patch rests
  Number fastest_push_m_s = 0.0F;  // at which an overlap is pushed apart without gravity
  int count = 0;
  PatchPointOf<Number> points[kManifoldPoints];
};

struct PatchConstraint : PatchOf<float> {
  std::uint32_t a = 0;  // indices of solver bodies
  std::uint32_t b = 0;
};

// work(k) for every point. The length is fixed, so that a GPU's compiler unrolls the loop and keeps points in
// registers.
template <typename Number, typename Work>
BROADSIDE_HD void each_point(const PatchOf<Number>& c, const Work& work) {
#if defined(__CUDACC__)
#pragma unroll
#endif
  for (int k = 0; k < kManifoldPoints; ++k)
    if (k < c.count) work(k);
}

// The same from the last one to the first.
template <typename Number, typename Work>
BROADSIDE_HD void each_point_back(const PatchOf<Number>& c, const Work& work) {
#if defined(__CUDACC__)
#pragma unroll
#endif
  for (int k = kManifoldPoints - 1; k >= 0; --k)
    if (k < c.count) work(k);
}

// d1 . M d2 of the point's mobility: how fast it moves along d2 for an impulse of 1 N s along d1, by body.
template <typename Body, typename Vector>
BROADSIDE_HD auto mobility(const Body& body, const Vector& arm, const Vector& d1, const Vector& d2) {
  return body.inverse_mass * dot(d1, d2) + dot(cross(arm, d1), body.inverse_inertia * cross(arm, d2));
}

// How far the patch reaches from the centers of mass: of its smaller moved body, m. What is small is measured in it.
BROADSIDE_HD float reach_of(const PatchConstraint& c, const SolverBody& a, const SolverBody& b) {
  float of_a = 0.0F;
  float of_b = 0.0F;
  each_point(c, [&](int k) {
    const PatchPoint& p = c.points[k];
    of_a = dot(p.arm_a, p.arm_a) > of_a ? dot(p.arm_a, p.arm_a) : of_a;
    of_b = dot(p.arm_b, p.arm_b) > of_b ? dot(p.arm_b, p.arm_b) : of_b;
  });
  if (!is_moved(a)) return sqrtf(of_b);
  if (!is_moved(b)) return sqrtf(of_a);
  return sqrtf(of_a < of_b ? of_a : of_b);
}

// How much of an impulse each point takes to change its speed, as its bodies are turned now.
template <typename Number, typename Body>
BROADSIDE_HD void set_masses(const PatchOf<Number>& c, PatchPointOf<Number>& p, const Body& a, const Body& b) {
  const auto entry = [&](const auto& d1, const auto& d2) {
    return mobility(a, p.arm_a, d1, d2) + mobility(b, p.arm_b, d1, d2);
  };
  p.normal_mass = 1.0F / entry(c.normal, c.normal);
  const Number k11 = entry(c.tangent_1, c.tangent_1);
  const Number k22 = entry(c.tangent_2, c.tangent_2);
  const Number k12 = entry(c.tangent_1, c.tangent_2);
  // The mobility is at least the inverse masses' sum in every direction, so its determinant is positive.
  const Number inverse = 1.0F / (k11 * k22 - k12 * k12);
  p.stick_mass_11 = inverse * k22;
  p.stick_mass_22 = inverse * k11;
  p.stick_mass_12 = -inverse * k12;
  const Number half = 0.5F * (k11 - k22);
  p.slide_mass = 1.0F / (0.5F * (k11 + k22) + square_root(half * half + k12 * k12));
}

// The same where it is asked for.
template <typename Number, typename Body>
BROADSIDE_HD void set_masses_where(TruthOf<Number> is_asked, const PatchOf<Number>& c, PatchPointOf<Number>& p,
                                   const Body& a, const Body& b) {
  PatchPointOf<Number> now = p;
  set_masses(c, now, a, b);
  p.normal_mass = pick(is_asked, now.normal_mass, p.normal_mass);
  p.stick_mass_11 = pick(is_asked, now.stick_mass_11, p.stick_mass_11);
  p.stick_mass_12 = pick(is_asked, now.stick_mass_12, p.stick_mass_12);
  p.stick_mass_22 = pick(is_asked, now.stick_mass_22, p.stick_mass_22);
  p.slide_mass = pick(is_asked, now.slide_mass, p.slide_mass);
}

// Whether a body has turned so far in the step that these are no longer those of its start, rad: a slender one that
// turns across itself is as much lighter to a point as it is longer than thick, and a sweep with masses twice too large
// does not converge. A needle that struck a plate at 100 m/s ended at no number.
template <typename Body>
BROADSIDE_HD auto has_turned_far(const Body& body) {
  constexpr float kFar_rad = 0x1p-8F;
  return dot(body.turned, body.turned) > kFar_rad * kFar_rad;
}

// center_b_from_a: from A's center of mass to B's, at the start of the step; of no matter where B is a face or static.
BROADSIDE_HD PatchConstraint make_constraint(const Manifold& manifold, const SolverBody& a, const SolverBody& b,
                                             Vec3 center_b_from_a, const Material& surface) {
  PatchConstraint c;
  c.normal = manifold.normal;
  c.tangent_1 = unit_across(c.normal);
  c.tangent_2 = cross(c.normal, c.tangent_1);
  c.surface = surface;
  c.count = manifold.count;
  each_point(c, [&](int k) {
    PatchPoint& p = c.points[k];
    p.arm_a = manifold.points[k].point;
    p.arm_b = manifold.points[k].point - center_b_from_a;
    p.gap_m = manifold.points[k].gap_m;
  });
  each_point(c, [&](int k) { set_masses(c, c.points[k], a, b); });
  return c;
}

// The two bodies of a patch while it is solved: velocities at hand, and what their angular momenta have gained.
template <typename Number>
struct PatchMotionOf {
  VectorOf<Number> v_a;
  VectorOf<Number> w_a;
  VectorOf<Number> gain_a;
  VectorOf<Number> v_b;
  VectorOf<Number> w_b;
  VectorOf<Number> gain_b;
};
using PatchMotion = PatchMotionOf<float>;

template <typename Number>
BROADSIDE_HD PatchMotionOf<Number> pick(TruthOf<Number> is_first, const PatchMotionOf<Number>& first,
                                        const PatchMotionOf<Number>& second) {
  return {pick(is_first, first.v_a, second.v_a),       pick(is_first, first.w_a, second.w_a),
          pick(is_first, first.gain_a, second.gain_a), pick(is_first, first.v_b, second.v_b),
          pick(is_first, first.w_b, second.w_b),       pick(is_first, first.gain_b, second.gain_b)};
}

template <typename Body>
BROADSIDE_HD PatchMotionOf<typename Body::Number> motion_of(const Body& a, const Body& b) {
  return {a.v, angular_velocity(a), {}, b.v, angular_velocity(b), {}};
}

template <typename Number>
BROADSIDE_HD VectorOf<Number> relative_velocity(const PatchMotionOf<Number>& m, const PatchPointOf<Number>& p) {
  return (m.v_a + cross(m.w_a, p.arm_a)) - (m.v_b + cross(m.w_b, p.arm_b));
}

template <typename Number, typename Body>
BROADSIDE_HD void push(PatchMotionOf<Number>& m, const Body& a, const Body& b, const PatchPointOf<Number>& p,
                       const VectorOf<Number>& impulse) {
  const VectorOf<Number> moment_a = cross(p.arm_a, impulse);
  m.v_a = m.v_a + a.inverse_mass * impulse;
  m.w_a = m.w_a + a.inverse_inertia * moment_a;
  m.gain_a = m.gain_a + moment_a;
  const VectorOf<Number> moment_b = cross(p.arm_b, impulse);
  m.v_b = m.v_b - b.inverse_mass * impulse;
  m.w_b = m.w_b - b.inverse_inertia * moment_b;
  m.gain_b = m.gain_b - moment_b;
}

// Static bodies are shared by patches of one color: they are not written.
template <typename Body>
BROADSIDE_HD void store(Body& body, const VectorOf<typename Body::Number>& v,
                        const VectorOf<typename Body::Number>& gain) {
  if (!any(is_moved(body))) return;
  body.v = pick(is_moved(body), v, body.v);
  body.angular_momentum = pick(is_moved(body), body.angular_momentum + gain, body.angular_momentum);
}

template <typename Number, typename Body>
BROADSIDE_HD void store(const PatchMotionOf<Number>& m, Body& a, Body& b) {
  store(a, m.v_a, m.gain_a);
  store(b, m.v_b, m.gain_b);
}

// The impulse on A, N s, of what acts along the normal and the tangents.
template <typename Number>
BROADSIDE_HD VectorOf<Number> impulse_of(const PatchOf<Number>& c, Number normal, Number tangent_1, Number tangent_2) {
  return (normal * c.normal + tangent_1 * c.tangent_1) + tangent_2 * c.tangent_2;
}

// What impulses that are known beforehand do to one body of a patch: the same as push and store do to it.
template <typename Body>
struct BodyGain {
  using Number = typename Body::Number;
  using Vector = VectorOf<Number>;
  Vector v;
  Vector gain;

  BROADSIDE_HD explicit BodyGain(const Body& body) : v(body.v), gain{} {}
  // On A.
  BROADSIDE_HD void add_to_a(const Body& a, const Vector& arm_a, const Vector& impulse) {
    v = v + a.inverse_mass * impulse;
    gain = gain + cross(arm_a, impulse);
  }
  // Of the impulse on A, on B.
  BROADSIDE_HD void add_to_b(const Body& b, const Vector& arm_b, const Vector& impulse) {
    v = v - b.inverse_mass * impulse;
    gain = gain - cross(arm_b, impulse);
  }
  BROADSIDE_HD void store(Body& body) const { core::store(body, v, gain); }
};

// How far the end of an arm went while its body turned by this vector, rad: sine and 1 - cosine by their series, which
// are off by a hundredth at 2.4 rad and are not followed farther. A thousandth of a radian is small enough for the
// first order. Without the second one a corner that swings past the lowest point of its circle went on down: small
// cubes that spin under heavy ones were pushed into the floor, and out of it again with energy.
template <typename Vector>
BROADSIDE_HD Vector swung(const Vector& turned, const Vector& arm) {
  const Vector first = cross(turned, arm);
  const auto squared = dot(turned, turned);
  const auto is_far = squared > 0x1p-20F;
  if (!any(is_far)) return first;
  const auto s = pick(squared < 6.0F, squared, 6.0F);
  const auto sine = 1.0F - s * (1.0F / 6.0F - s * (1.0F / 120.0F - s * (1.0F / 5040.0F)));
  const auto versine = 0.5F - s * (1.0F / 24.0F - s * (1.0F / 720.0F - s * (1.0F / 40320.0F)));
  return pick(is_far, sine * first + versine * cross(turned, first), first);
}

// The gap now: that of the start, and how far the bodies moved along the normal since.
template <typename Number, typename Body>
BROADSIDE_HD Number gap_now(const PatchOf<Number>& c, const PatchPointOf<Number>& p, const Body& a, const Body& b) {
  const VectorOf<Number> moved_a = a.moved + swung(a.turned, p.arm_a);
  const VectorOf<Number> moved_b = b.moved + swung(b.turned, p.arm_b);
  return p.gap_m + dot(c.normal, moved_a - moved_b);
}

// N s on A, of the whole step.
BROADSIDE_HD Vec3 total_impulse(const PatchConstraint& c, const PatchPoint& p) {
  return impulse_of(c, p.normal_total, p.tangent_total_1, p.tangent_total_2);
}

}  // namespace broadside::core
