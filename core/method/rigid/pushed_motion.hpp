// Where a body may be driven within a step by what strikes it; contacts are looked for there too. RIGID 8.7.
//
// A body that is struck moves on within the same step, and may then meet bodies that its own motion does not lead to.
// So each pair of a step's candidates, whose boxes are swept over two steps, tells the next step which body comes
// toward which. Before, a cube at rest that was struck at 3 m/s ended 5 cm deep in the one below it.
//
// A body passes on a push that it gets to its neighbors, within the same step. Before, when the first of two touching
// cubes was struck at 20 m/s, it drove the second one 24 mm into a third cube, 5 cm beyond.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

// The strongest push that a body may be given, as one word: the upper half is how far it drives the body in a step (m,
// the bits of a nonnegative float), the lower half is the body that strikes it. So a stronger push is a larger word,
// and the largest of several does not depend on their order. 0 = none.
using PushWord = std::uint64_t;

BROADSIDE_HD constexpr float push_m(PushWord push) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(push >> 32));
}
BROADSIDE_HD constexpr std::uint32_t pusher_of(PushWord push) {
  return static_cast<std::uint32_t>(push);
}

// The share of b's speed toward a that a gets by an impact: if both bodies stick together, the speed that they then
// have; if they bounce, up to twice that.
BROADSIDE_HD constexpr float share_of_push(float inverse_mass_a, float inverse_mass_b, float restitution) {
  if (!(inverse_mass_a > 0.0F)) return 0.0F;
  return (1.0F + restitution) * (inverse_mass_a / (inverse_mass_a + inverse_mass_b));
}

// What is needed of one body of a pair to compute the push that it gives the other.
struct Pusher {
  Vec3 x;                     // of the center of mass, m
  Vec3 drift;                 // how far its velocity moves it in a step, m
  Vec3 pushed;                // how far a pusher drives this body, m
  float swing_m = 0.0F;       // what turning adds
  float inverse_mass = 0.0F;  // 1/kg
  std::uint32_t body = 0;
  std::uint32_t pusher = 0;  // the body that drives it
};

// The push that b gives a in the next step: by b's own motion, or by the motion that another body is about to give b,
// unless that other body is a. Bodies that move apart push nothing. Before, a body that fell on another one got back
// its own push, which leads nowhere, in place of the one that came from above: in a heap, cubes that were struck again
// ended up to 46 mm deep in those that they had just left.
BROADSIDE_HD PushWord push_by(const Pusher& a, const Pusher& b, float restitution) {
  const float share = share_of_push(a.inverse_mass, b.inverse_mass, restitution);
  const Vec3 own = b.drift - a.drift;
  const float toward = dot(own, a.x - b.x);
  const float own_m = (toward > 0.0F ? length(own) : 0.0F) + b.swing_m;
  const float given_m = length(b.pushed);
  // A push that came from a does not count for a.
  const bool is_given = given_m > own_m && b.pusher != a.body;
  const float strength = share * (is_given ? given_m : own_m);
  if (!(strength > 0.0F)) return 0;
  return (static_cast<PushWord>(std::bit_cast<std::uint32_t>(strength)) << 32) | (is_given ? b.pusher : b.body);
}

// The stronger of a push that a body gets directly and one that is passed on to it.
BROADSIDE_HD constexpr PushWord stronger_push(PushWord a, PushWord b) {
  return a > b ? a : b;
}

// The push, m, in the direction in which the pusher now moves against the body. drift, drift_of_pusher: how far each
// moves in a step.
BROADSIDE_HD Vec3 pushed_way(PushWord push, Vec3 drift, Vec3 drift_of_pusher) {
  const Vec3 way = drift_of_pusher - drift;
  const float size = length(way);
  return size > 0.0F ? (push_m(push) / size) * way : Vec3{};
}

// The body, with the push that it got for the next step where that one is stronger. drift_of_pusher: of the body that
// strikes it.
BROADSIDE_HD Pusher told_of(Pusher body, PushWord push, Vec3 drift_of_pusher) {
  if (!(push_m(push) > length(body.pushed))) return body;
  body.pushed = pushed_way(push, body.drift, drift_of_pusher);
  body.pusher = pusher_of(push);
  return body;
}

// How far the push may take a body along a direction of length 1. Without friction, a body that is struck moves along
// the normal of the contact, which may be any normal that faces the pusher; so its motion ends in the ball whose
// diameter is the push.
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

// How far two bodies may approach each other although their own motion does not lead them there: by gravity, and by
// pushes of others.
struct NearReach {
  float falls_m = 0.0F;  // of both
  Vec3 pushed_a;
  Vec3 pushed_b;
};

// A patch whose gap is at most this is kept even if free motion passes it by. normal: from b to a.
BROADSIDE_HD float near_m(Vec3 normal, const NearReach& near) {
  return near.falls_m + (pushed_reach_m(near.pushed_a, -normal) + pushed_reach_m(near.pushed_b, normal));
}

// At least near_m of every unit normal that differs from this one by a vector no longer than `off`.
BROADSIDE_HD float near_at_most_m(Vec3 normal, float off, const NearReach& near) {
  const float pushed_m = length(near.pushed_a) + length(near.pushed_b);
  return (1.0F + 0x1p-20F) * (near_m(normal, near) + 0.5F * off * pushed_m);
}

// At least near_m of every normal.
BROADSIDE_HD float near_at_most_m(const NearReach& near) {
  return (1.0F + 0x1p-20F) * (near.falls_m + (length(near.pushed_a) + length(near.pushed_b)));
}

}  // namespace broadside::core
