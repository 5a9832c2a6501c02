#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/mutants/mutants.hpp"

namespace broadside::reference {
namespace {

using core::Contact;
using core::Material;
using core::Parameters;
using core::Vec3;

float approach(const Contact& c) {
  return core::dot(c.pre_a.v - c.pre_b.v, c.normal);
}

// A further impulse along a direction, on both bodies.
void push(const Application& a, float impulse_n_s, Vec3 direction) {
  a.c.post_a.v = a.c.post_a.v + (impulse_n_s * a.w_a) * direction;
  a.c.post_b.v = a.c.post_b.v - (impulse_n_s * a.w_b) * direction;
}

void push_normal(const Application& a, float impulse_n_s) {
  a.c.normal_impulse_n_s += impulse_n_s;
  push(a, impulse_n_s, a.c.normal);
}

void push_tangent(const Application& a, float impulse_n_s) {
  a.c.tangent_impulse_n_s += impulse_n_s;
  push(a, impulse_n_s, a.c.tangent);
}

using Respond = void (*)(const World&, const Application&);

constexpr Respond kBouncesBelowThreshold = [](const World&, const Application& a) {
  a.apply_with([](Parameters& q) { q.v_threshold_m_s = 0.0F; });
};

constexpr Respond kNeverBounces = [](const World&, const Application& a) {
  Material n = a.m;
  n.restitution = 0.0F;
  a.apply(n, a.p);
};

constexpr Respond kStopsSeparating = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  const float v_n = approach(a.c);
  if (v_n > 0.0F) push_normal(a, -v_n / (a.w_a + a.w_b));
};

constexpr Respond kBouncesTooHard = [](const World&, const Application& a) {
  Material n = a.m;
  n.restitution = 1.0F + a.m.restitution;
  a.apply(n, a.p);
};

constexpr Respond kFloorsTwiceNeutral = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  const float v_n = approach(a.c);
  const float wanted = std::min(a.p.impulse_min_n_s, -4.0F * v_n / (a.w_a + a.w_b));
  if (v_n < 0.0F && a.c.normal_impulse_n_s < wanted) push_normal(a, wanted - a.c.normal_impulse_n_s);
};

constexpr Respond kPulls = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  push_normal(a, -2.0F * a.c.normal_impulse_n_s);
};

constexpr Respond kForgetsOneMass = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  if (a.w_a > 0.0F && a.w_b > 0.0F) push_normal(a, a.c.normal_impulse_n_s * (a.w_b / a.w_a));
};

constexpr Respond kSlidesWithStatic = [](const World&, const Application& a) {
  Material n = a.m;
  n.mu_kinetic = a.m.mu_static;
  a.apply(n, a.p);
};

constexpr Respond kSticksByKinetic = [](const World&, const Application& a) {
  Material n = a.m;
  n.mu_static = a.m.mu_kinetic;
  a.apply(n, a.p);
};

constexpr Respond kNoFriction = [](const World&, const Application& a) {
  Material n = a.m;
  n.mu_static = n.mu_kinetic = 0.0F;
  a.apply(n, a.p);
};

constexpr Respond kFrictionBeforeFloor = [](const World&, const Application& a) {
  const Contact before = a.c;
  a.apply_with([](Parameters& q) { q.impulse_min_n_s = 0.0F; });
  const float unfloored_n_s = a.c.tangent_impulse_n_s;
  a.c = before;
  a.apply(a.m, a.p);
  push_tangent(a, unfloored_n_s - a.c.tangent_impulse_n_s);
};

constexpr Respond kFrictionAlongVelocity = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  const float impulse = a.c.tangent_impulse_n_s;
  if (impulse == 0.0F) return;
  push_tangent(a, -impulse);
  const Vec3 relative = a.c.pre_a.v - a.c.pre_b.v;
  a.c.tangent = (1.0F / core::length(relative)) * relative;
  push_tangent(a, impulse);
};

constexpr Respond kTangentNotUnit = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  const float impulse = a.c.tangent_impulse_n_s;
  if (impulse == 0.0F) return;
  push_tangent(a, -impulse);
  const Vec3 relative = a.c.pre_a.v - a.c.pre_b.v;
  a.c.tangent = relative - core::dot(relative, a.c.normal) * a.c.normal;
  push_tangent(a, impulse);
};

constexpr Respond kRubsSeparating = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  const Vec3 relative = a.c.pre_a.v - a.c.pre_b.v;
  const Vec3 sliding = relative - approach(a.c) * a.c.normal;
  if (!(approach(a.c) > 0.0F) || !(core::length(sliding) > 0.0F)) return;
  a.c.tangent = (1.0F / core::length(sliding)) * sliding;
  push_tangent(a, -0.1F * core::length(sliding) / (a.w_a + a.w_b));
};

constexpr Respond kStopsTooHard = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  push_tangent(a, 0.5F * a.c.tangent_impulse_n_s);
};

// 0 / 0 where nothing slides.
constexpr Respond kDividesByZero = [](const World&, const Application& a) {
  a.apply(a.m, a.p);
  if (a.c.normal_impulse_n_s == 0.0F || a.c.tangent_impulse_n_s != 0.0F) return;
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  a.c.tangent = {kNaN, kNaN, kNaN};
  push_tangent(a, 0.0F);
};

std::span<const Mutant> velocity_table() {
  static const auto kTable = std::to_array<Mutant>({
      {"bounces-below-threshold",
       "slow approaches bounce too",
       "restitution",
       "mixed",
       {.respond = kBouncesBelowThreshold}},
      {"never-floors",
       "the impulse floor is left out",
       "restitution",
       "errata:E5",
       {.respond = [](const World&,
                      const Application& a) { a.apply_with([](Parameters& q) { q.impulse_min_n_s = 0.0F; }); }}},
      {"never-bounces", "restitution is left out", "restitution", "mixed", {.respond = kNeverBounces}},
      {"takes-smaller-restitution",
       "the smaller of two restitutions",
       "restitution",
       "pile",
       {.combine =
            [](const Material& a, const Material& b) {
              Material m = core::combine(a, b);
              m.restitution = std::min(a.restitution, b.restitution);
              return m;
            }}},
      {"stops-separating", "contacts that separate are stopped", "restitution", "mixed", {.respond = kStopsSeparating}},
      {"bounces-too-hard", "restitution is too large by one", "normal-energy", "mixed", {.respond = kBouncesTooHard}},
      {"floors-twice-neutral",
       "the impulse floor goes to twice the neutral impulse",
       "normal-energy",
       "errata:E5",
       {.respond = kFloorsTwiceNeutral}},
      {"pulls", "the normal impulse has the wrong sign", "normal-energy", "mixed", {.respond = kPulls}},
      {"forgets-one-mass",
       "the impulse is divided by one inverse mass instead of their sum",
       "normal-energy",
       "mixed",
       {.respond = kForgetsOneMass}},
      {"records-half-the-impulse",
       "half of the impulse that acted is recorded",
       "normal-energy",
       "mixed",
       {.store = [](const World&, Contact& c) { c.normal_impulse_n_s *= 0.5F; }}},
      {"slides-with-static",
       "sliding friction uses the static coefficient",
       "friction-energy",
       "mixed",
       {.respond = kSlidesWithStatic}},
      {"sticks-by-kinetic",
       "the kinetic coefficient decides about sticking",
       "friction-energy",
       "pile",
       {.respond = kSticksByKinetic}},
      {"no-friction", "friction is left out", "friction-energy", "mixed", {.respond = kNoFriction}},
      {"friction-before-floor",
       "friction's cone is that of the impulse before the floor",
       "friction-energy",
       "pile",
       {.respond = kFrictionBeforeFloor}},
      {"friction-along-velocity",
       "friction opposes the whole relative velocity",
       "friction-energy",
       "mixed",
       {.respond = kFrictionAlongVelocity}},
      {"tangent-not-unit",
       "friction's direction is not normalized",
       "friction-energy",
       "mixed",
       {.respond = kTangentNotUnit}},
      {"rubs-separating",
       "friction acts on contacts that separate",
       "friction-energy",
       "mixed",
       {.respond = kRubsSeparating}},
      {"stops-too-hard", "friction is 50 % too strong", "friction-energy", "mixed", {.respond = kStopsTooHard}},
      {"averages-friction",
       "the mean of two frictions, where the geometric mean belongs",
       "friction-energy",
       "pile",
       {.combine =
            [](const Material& a, const Material& b) {
              Material m = core::combine(a, b);
              m.mu_static = 0.5F * (a.mu_static + b.mu_static);
              m.mu_kinetic = 0.5F * (a.mu_kinetic + b.mu_kinetic);
              return m;
            }}},
      {"books-half-the-friction",
       "half of the friction that acted is recorded",
       "energy",
       "mixed",
       {.store = [](const World&, Contact& c) { c.tangent_impulse_n_s *= 0.5F; }}},
      {"heats-at-the-end",
       "velocities grow by a part in a thousand after all contacts",
       "energy",
       "mixed",
       {.end =
            [](World& w) {
              for (std::uint32_t i = 0; i < w.bodies.count(); ++i)
                if (w.bodies.is_static[i] == 0) w.bodies.state[i].v = 1.001F * w.bodies.state[i].v;
            }}},
      {"divides-by-zero",
       "where nothing slides, friction's direction is NaN",
       "state-sanity",
       "two-body:head-on",
       {.respond = kDividesByZero}},
      {"never-clips",
       "the velocity cap is left out",
       "velocity-cap",
       "fast",
       {.clip = [](Vec3 v, float) { return v; }}},
      {"clips-one-side",
       "only positive components are clipped",
       "velocity-cap",
       "fast",
       {.clip =
            [](Vec3 v, float v_max) {
              for (int k = 0; k < 3; ++k) v[k] = std::min(v[k], v_max);
              return v;
            }}},
      {"clips-twice-too-high",
       "the cap is twice v_max",
       "velocity-cap",
       "fast",
       {.clip = [](Vec3 v, float v_max) { return core::clipped(v, 2.0F * v_max); }}},
      {"clips-the-speed",
       "the speed is limited where the components should be",
       "state-sanity",
       "fast",
       {.clip =
            [](Vec3 v, float v_max) {
              const float speed = core::length(v);
              return speed > v_max ? (v_max / speed) * v : v;
            }}},
  });
  return kTable;
}

}  // namespace

std::span<const Mutant> velocity_mutants() {
  return velocity_table();
}

}  // namespace broadside::reference
