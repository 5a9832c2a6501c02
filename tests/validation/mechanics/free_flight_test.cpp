// ballistic, turning, gyroscopic and box-contains: what a body does while it touches nothing.
#include <cmath>

#include "core/contact.hpp"
#include "tests/validation/mechanics/one_step.hpp"

namespace broadside::tests {
namespace {

using bench::Specimen;

// A fall from rest: dv = -g h = -1/8 m/s, and a displacement of half of h dv.
Specimen fallen(double more_velocity, double more_way) {
  Specimen r = one_step(1);
  end_step(r, [&](core::WideStates& s) {
    s.velocity[0].y = -kG * kStep + more_velocity;
    s.position[0].y = -0.5 * kG * kStep * kStep + more_way;
  });
  return r;
}

TEST(Ballistic, AllowsTheRoundingOfTheVelocity) {
  EXPECT_EQ(law("ballistic", fallen(0, 0)).outcome, core::Outcome::kPass);
  // 6 u of g h = 1/8 m/s, and of the velocities 0 and 1/8 m/s 7 u: the record's, the sum's, and 5 of a turn from the
  // body's axes, three products and two sums.
  expect_limit("ballistic", 13 * kU / 8, [](double off) { return fallen(off, 0); },
               {"dv = -0.125 m/s", "g h + F h / m = -0.125 m/s"});
}

TEST(Ballistic, AllowsAWayBetweenBothVelocities) {
  // From rest to -1/8 m/s: the displacement is between 0 and -h/8; the limit is 4 u of that, and h times the limit of
  // the velocity.
  const double limit = 4 * kU * kStep / 8 + kStep * 13 * kU / 8;
  expect_limit("ballistic", limit, [](double off) { return fallen(0, 0.5 * kG * kStep * kStep + off); },
               {"dx = ", "h v = 0 to"});
}

TEST(Ballistic, ExcusesNoBodyForWhereItWent) {
  Specimen r = one_step(2);
  r.header.scene.bodies[1].position = {5, 0, 0};
  end_step(r, [](core::WideStates& s) {
    for (core::WideVec3& v : s.velocity) v.y = -kG * kStep;
    std::swap(s.position[0], s.position[1]);
  });
  EXPECT_EQ(law("ballistic", r).violations, 2U) << told(law("ballistic", r));
}

TEST(Ballistic, LooksAtNoBodyThatMayTouch) {
  Specimen r = one_step(2);
  r.header.scene.bodies[1].position = {1, 0, 0};
  end_step(r, [](core::WideStates& s) { s.velocity[0].x = 1.0; });
  expect_nothing_met("ballistic", r, "no moving body was free of contact");
  expect_nothing_met("ballistic", only_static(), "no moving body was free of contact");
}

// The flight of `fallen` as a scene with an exact answer, by an engine of so many substeps a step.
Specimen answered_fall(const std::string& substeps, double off) {
  Specimen r = fallen(off, 0);
  r.header.scene.answer = "flight";
  r.header.declaration = core::Declaration::of({{"precision", "f32"}, {"substeps", substeps}});
  return r;
}

TEST(ClosedForm, AllowsTheRoundingOfEverySubstep) {
  // 4 u of |v| + |g| h = 1/4 m/s, each time a substep adds to the velocity.
  for (const int substeps : {1, 16})
    expect_limit("closed-form", substeps * 4 * kU / 4,
                 [&](double off) { return answered_fall(std::to_string(substeps), off); }, {"velocity is off by "});
}

// A body that spins about z by 16 rad/s turns by 1/4 rad.
Specimen turned(double more, const std::string& motion = "rigid") {
  Specimen r = one_step(1);
  r.header.declaration = core::Declaration::of({{"precision", "f32"}, {"motion", motion}});
  r.header.scene.bodies[0].angular_velocity = {0, 0, 16};
  end_step(r, [&](core::WideStates& s) {
    const double half = 0.5 * (16 * kStep + more);
    s.orientation[0] = {std::cos(half), 0, 0, std::sin(half)};
  });
  return r;
}

TEST(Turning, AllowsANormalizedTurnOfFirstOrder) {
  const double turn = 16 * kStep;
  // 2 atan(turn / 2) is turn - turn^3 / 12; quaternions round 24 times, and 8 times the turn.
  const double limit = turn * turn * turn / 12 + (24 + 8 * turn) * kU;
  expect_limit("turning", limit, [](double off) { return turned(off); }, {"the body turned by ", "h |w| = 0.25 rad"});
  expect_limit("turning", limit, [](double off) { return turned(-off); });
}

TEST(Turning, HoldsAnEngineToTranslationsThatItDeclares) {
  EXPECT_EQ(law("turning", turned(0)).outcome, core::Outcome::kPass);
  EXPECT_EQ(law("turning", turned(0, "translate")).outcome, core::Outcome::kFail);
}

TEST(Turning, KnowsThatAMillionRadiansASecondAreNotRest) {
  Specimen r = one_step(1);
  r.header.scene.bodies[0].angular_velocity = {0, 1e6F, 0};
  end_step(r, [](core::WideStates&) {});
  const core::Verdict v = law("turning", r);
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NE(v.origin.find("does not keep its orientation"), std::string::npos) << told(v);
}

// Moments 1, 2, 3 and w = (2, 2, 0): L = (2, 4, 0), and |w x L| = 4 N m.
Specimen spun(core::WideVec3 w) {
  Specimen r = one_step(1, {1, 2, 3});
  r.header.scene.bodies[0].angular_velocity = {2, 2, 0};
  end_step(r, [&](core::WideStates& s) { s.angular_velocity[0] = w; });
  return r;
}

TEST(Gyroscopic, AllowsHalfOfWhatTheTorqueDoesInAStep) {
  const double spin = std::sqrt(8.0);
  const double limit = 0.5 * kStep * 4 + 40 * kU * 3 * (spin + std::sqrt(20.0));
  expect_limit("gyroscopic", limit,
               [](double off) {
                 return spun({2, 2, off / 3});
               },
               {"L went from (2, 4, 0)", "h |w x L| = "});
}

TEST(Gyroscopic, AllowsTheSecondOrderOfTheSpinsEnergy) {
  const double turn = kStep * std::sqrt(8.0);
  // (h 4 N m)^2 over the least moment of 1 kg m^2; the energy is 6 J and goes with the square of the spin.
  const double spin = std::sqrt(8.0);
  const double rounding = 40 * kU * 3 * (spin + std::sqrt(20.0)) * spin;
  const double limit = 16 * kStep * kStep + turn * turn * turn / 12 * 4 + rounding;
  const auto with_energy = [](double off) {
    const double s = std::sqrt(1 + off / 6);
    return spun({2 * s, 2 * s, 0});
  };
  expect_limit("gyroscopic", limit, with_energy, {"the energy of the spin went from 6 to 6.0"});
}

TEST(Gyroscopic, SaysHowManyWereTooFast) {
  Specimen r = one_step(1, {1, 2, 3});
  r.header.scene.bodies[0].angular_velocity = {7, 0, 0};
  end_step(r, [](core::WideStates&) {});
  expect_nothing_met("gyroscopic", r, "no moving body was free of contact");
}

// The box's side at 1/2 m, moved in.
Specimen boxed(double in) {
  Specimen r = one_step(1);
  r.header.groups |= core::bit(core::Group::kDetection);
  core::FrameRecord& f = end_step(r, [](core::WideStates&) {});
  f.detected_position.resize(1);
  f.detected_velocity.resize(1);
  f.boxes = {{{-0.5F, -0.5F, -0.5F}, {static_cast<float>(0.5 - in), 0.5F, 0.5F}}};
  return r;
}

TEST(BoxContains, AllowsTheRoundingOfPoseAndBox) {
  // 24 u of the half diagonal.
  expect_limit("box-contains", 24 * kU * std::sqrt(0.75), boxed,
               {"the shape reaches from -0.5 to 0.5 m", "the box from"});
}

TEST(BoxContains, TellsHowMuchTooLargeBoxesAre) {
  EXPECT_NE(law("box-contains", boxed(-0.25)).explanation.find("0.25 m wider"), std::string::npos);
}

}  // namespace
}  // namespace broadside::tests
