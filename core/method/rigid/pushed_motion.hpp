// Where a body may be driven within a step by what strikes it: contacts are looked for there too. RIGID 8.7.
//
// A body that is struck moves on within the same step, and may meet in it what its own motion never led to. So each
// pair of a step's candidates, whose boxes are swept over two steps, tells the next step who comes toward whom. Before,
// a cube at rest that was struck at 3 m/s ended 5 cm deep in the one below it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

// The strongest push that a body may be given, as one word that is larger for a stronger one: how far it drives the
// body in a step (m, the bits of a float from 0 on) and below that the body that comes. The largest of several depends
// on no order. 0 = none.
using PushWord = std::uint64_t;

BROADSIDE_HD constexpr float push_m(PushWord push) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(push >> 32));
}
BROADSIDE_HD constexpr std::uint32_t pusher_of(PushWord push) {
  return static_cast<std::uint32_t>(push);
}

// Of the speed at which b comes toward it, a takes over this share where both stick together after the impact, and up
// to twice that where they bounce.
BROADSIDE_HD constexpr float share_of_push(float inverse_mass_a, float inverse_mass_b, float restitution) {
  if (!(inverse_mass_a > 0.0F)) return 0.0F;
  return (1.0F + restitution) * (inverse_mass_a / (inverse_mass_a + inverse_mass_b));
}

// A body of a pair as the other one may feel it.
struct Pusher {
  Vec3 x;                     // of the center of mass, m
  Vec3 drift;                 // by its velocity, of a step, m
  Vec3 pushed;                // as it is driven itself, m
  float swing_m = 0.0F;       // what turning adds
  float inverse_mass = 0.0F;  // 1/kg
  std::uint32_t body = 0;
  std::uint32_t pusher = 0;  // that drives it
};

// What b does to a in the next step: by its own motion, or by that which it is about to be given, unless a gives it.
// Before, a body that fell on another was told of its own push, which leads nowhere, in place of the one that came from
// above: cubes of a heap that were struck again ended up to 46 mm in those that they had just left. Bodies that go
// apart push nothing.
BROADSIDE_HD PushWord push_by(const Pusher& a, const Pusher& b, float restitution) {
  const float share = share_of_push(a.inverse_mass, b.inverse_mass, restitution);
  const Vec3 own = b.drift - a.drift;
  const float toward = dot(own, a.x - b.x);
  const float own_m = (toward > 0.0F ? length(own) : 0.0F) + b.swing_m;
  const float given_m = length(b.pushed);
  // What a itself gave comes back as nothing.
  const bool is_given = given_m > own_m && b.pusher != a.body;
  const float strength = share * (is_given ? given_m : own_m);
  if (!(strength > 0.0F)) return 0;
  return (static_cast<PushWord>(std::bit_cast<std::uint32_t>(strength)) << 32) | (is_given ? b.pusher : b.body);
}

// A push in the direction in which the pusher now moves against the body, m. drift: of each in a step.
BROADSIDE_HD Vec3 pushed_way(PushWord push, Vec3 drift, Vec3 drift_of_pusher) {
  const Vec3 way = drift_of_pusher - drift;
  const float size = length(way);
  return size > 0.0F ? (push_m(push) / size) * way : Vec3{};
}

// A body that is struck without friction moves along the normal of the contact, which may be any that faces the pusher:
// it ends in the ball whose diameter is the push. How far that ball reaches along a direction, of length 1.
BROADSIDE_HD float pushed_reach_m(Vec3 pushed, Vec3 direction) {
  return 0.5F * (length(pushed) + dot(pushed, direction));
}

// The box of a body, grown by that ball.
BROADSIDE_HD Box pushed_box(Box box, Vec3 pushed) {
  const float radius = 0.5F * length(pushed);
  if (!(radius > 0.0F)) return box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = box.min[k] + fminf(0.5F * pushed[k] - radius, 0.0F);
    box.max[k] = box.max[k] + fmaxf(0.5F * pushed[k] + radius, 0.0F);
  }
  return box;
}

// What brings two bodies together that do not move toward each other.
struct NearReach {
  float falls_m = 0.0F;  // of both
  Vec3 pushed_a;
  Vec3 pushed_b;
};

// Apart by no more than this, a patch is kept though free motion leads past it: normal points from b to a.
BROADSIDE_HD float near_m(Vec3 normal, const NearReach& near) {
  return near.falls_m + (pushed_reach_m(near.pushed_a, -normal) + pushed_reach_m(near.pushed_b, normal));
}

// No less than near_m of any normal that is no farther than off from this one: both are units.
BROADSIDE_HD float near_at_most_m(Vec3 normal, float off, const NearReach& near) {
  const float pushed_m = length(near.pushed_a) + length(near.pushed_b);
  return (1.0F + 0x1p-20F) * (near_m(normal, near) + 0.5F * off * pushed_m);
}

// Whatever the normal.
BROADSIDE_HD float near_at_most_m(const NearReach& near) {
  return (1.0F + 0x1p-20F) * (near.falls_m + (length(near.pushed_a) + length(near.pushed_b)));
}

}  // namespace broadside::core
