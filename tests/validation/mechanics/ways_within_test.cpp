// Points that were found within a step and are recorded at its start: how far the laws let them have moved.
#include <gtest/gtest.h>

#include "core/contact.hpp"
#include "tests/validation/mechanics/one_step.hpp"

namespace broadside::tests {
namespace {

// A body at 4 m/s that the floor pushes by 0.25 N s, half a meter beside and below its center. Its spin at the end
// differs by `off` from the one that follows.
bench::Specimen pushed(const char* detection_at, double off) {
  bench::Specimen r = one_step(1);
  r.header.declaration = core::Declaration::of({{"precision", "f32"}, {"detection_at", detection_at}});
  r.header.scene.bodies[0].velocity = {4, 0, 0};
  end_step(r, [off](core::WideStates& s) {
    s.position[0].x += 4.0 * kStep;
    s.velocity[0].y = 0.25 - kG * kStep;
    s.angular_velocity[0].z = 0.125 + off;
  });
  add_point(r, {0, core::kFirstFace + 2, {0.5F, -0.5F, 0}, {0, 1, 0}, 0.0F, {0, 0.25F, 0}, 1});
  return r;
}

// J = 0.25 N s, times h (4 m/s + h g + J / 1 kg + (0.125 N m s / 1 kg m^2) sqrt(1/2) m).
constexpr double kLimit = 0.25 * kStep * (4.0 + 0.125 + 0.25 + 0.125 * 0.70710678118654752);

TEST(WaysWithin, AMomentIsKnownToHowFarTheBodyCameWithinTheStep) {
  expect_limit("angular-momentum", kLimit, [](double off) { return pushed("within", off); });
}

TEST(WaysWithin, WhatIsFoundAtTheStartIsWhereItIsTold) {
  const core::Verdict v = law("angular-momentum", pushed("start", 0.1 * kLimit));
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
}

// An engine that detects again only in some steps.
TEST(WaysWithin, AStepThatWasTakenAtOnceHasNoOther) {
  const auto by_parts = [](std::uint32_t parts) {
    bench::Specimen r = pushed("within", 0.1 * kLimit);
    r.frames.back().parts = parts;
    return law("angular-momentum", r).outcome;
  };
  EXPECT_EQ(by_parts(0), core::Outcome::kPass);
  EXPECT_EQ(by_parts(1), core::Outcome::kFail);
  EXPECT_EQ(by_parts(2), core::Outcome::kPass);
}

}  // namespace
}  // namespace broadside::tests
