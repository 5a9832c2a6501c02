// momentum, angular-momentum, friction-cone and unilateral: the laws about what contact points do to bodies.
#include <cmath>

#include "core/contact.hpp"
#include "tests/validation/mechanics/one_step.hpp"

namespace broadside::tests {
namespace {

using bench::Specimen;

core::Vec3 single(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// A body of 1 kg whose lowest point is on the floor, with one point below its center.
Specimen on_floor(core::Vec3 v0, core::WideVec3 v1, core::Vec3 impulse, double gap = 0.0) {
  Specimen r = one_step(1);
  r.header.scene.domain.min.y = -0.5F;
  r.header.scene.bodies[0].velocity = v0;
  end_step(r, [&](core::WideStates& s) { s.velocity[0] = v1; });
  core::ContactPoint p;
  p.a = 0;
  p.b = core::kFirstFace + 2;
  p.point = {0, -0.5F, 0};
  p.normal = {0, 1, 0};
  p.gap_m = static_cast<float>(gap);
  p.impulse = impulse;
  add_point(r, p);
  return r;
}

TEST(Momentum, AllowsTheRoundingOfItsAdditions) {
  // At rest: m g h = 1/8 N s and J as much. 4 + 2 additions of 1/4 m/s for this point, 2 for each of four points that
  // may have been taken back, two turns of 5 operations into the body's axes and out of them, and 4 u of J in float32.
  const double limit = 24 * kU * 0.25 + 4 * kU * 0.125;
  expect_limit("momentum", limit,
               [](double off) {
                 return on_floor({}, {0, off, 0}, {0, 0.125F, 0});
               },
               {"m dv = ", "m g h + sum J = (0, 0, 0) N s"});
}

// A second step, in which the first body ends as `change` leaves it; its points give no impulses.
template <typename Change>
void add_idle_step(Specimen& r, const Change& change) {
  core::FrameRecord frame = r.frames.back();
  frame.step = 2;
  frame.time_s = 2 * kStep;
  for (core::ContactPoint& p : frame.points) p.impulse = {};
  change(frame.wide);
  frame.velocity[0] = core::narrowed(frame.wide.velocity[0]);
  frame.angular_velocity[0] = core::narrowed(frame.wide.angular_velocity[0]);
  r.frames.push_back(frame);
}

// A solver that begins a step with the 1 N s of the one before takes them back, to within rounding.
TEST(Momentum, AllowsTheRoundingOfImpulsesThatAreTakenBack) {
  const auto stopped = [](double off) {
    Specimen r = on_floor({0, -1, 0}, {}, {0, 1, 0});
    r.header.scene.gravity_m_s2 = {};
    add_idle_step(r, [off](core::WideStates& s) { s.velocity[0].y = off; });
    return r;
  };
  expect_limit("momentum", 24 * kU, stopped, {"m g h + sum J = (0, 0, 0) N s"});
  // What is two steps old is nothing that a solver begins with.
  Specimen later = stopped(0);
  core::FrameRecord third = later.frames.back();
  third.step = 3;
  third.wide.velocity[0].y = 10 * kU;
  third.velocity[0].y = static_cast<float>(10 * kU);
  later.frames.push_back(third);
  EXPECT_EQ(law("momentum", later).outcome, core::Outcome::kFail) << told(law("momentum", later));
}

// A gap of -1/64 m, which a correction of all of it closes at 1 m/s.
Specimen deep(Specimen r, const char* correction) {
  r.header.scene.gravity_m_s2 = {};
  r.header.declaration =
      core::Declaration::of({{"precision", "f32"}, {"detection_at", "start"}, {"correction", correction}});
  r.frames.back().points[0].gap_m = -static_cast<float>(kStep);
  return r;
}

TEST(Momentum, AllowsTheRoundingOfACorrectionThatIsTakenBack) {
  const auto pushed = [](double off) { return deep(on_floor({}, {0, off, 0}, {}), "position"); };
  expect_limit("momentum", 24 * kU, pushed, {"m g h + sum J = (0, 0, 0) N s"});
  const core::Verdict v = law("momentum", deep(on_floor({}, {0, kU, 0}, {}), "none"));
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
}

TEST(Momentum, WithoutPointsIsThatOfBodiesThatMeet) {
  const auto met = [](double off) {
    Specimen r = one_step(2);
    r.header.scene.gravity_m_s2 = {};
    r.header.scene.bodies[0].velocity = {1, 0, 0};
    r.header.scene.bodies[1].position = {1, 0, 0};
    end_step(r, [&](core::WideStates& s) { std::swap(s.velocity[0], s.velocity[1]), s.velocity[1].x += off; });
    return r;
  };
  // 4 + 2 additions a body of the set, of 2 kg m/s before and after.
  expect_limit("momentum", 8 * kU * 2, met, {"sum m dv = ", "over 2 bodies"});
}

// An engine that reports where bodies touch and not how hard: no law is applied to its impulses of zero.
TEST(Momentum, ReadsNoImpulsesWherePointsAreGeometry) {
  Specimen r = on_floor({}, {0, 0, 0}, {});
  EXPECT_EQ(law("momentum", r).outcome, core::Outcome::kFail) << told(law("momentum", r));
  r.header.declaration = core::Declaration::of({{"contacts", "geometry"}});
  EXPECT_EQ(law("momentum", r).outcome, core::Outcome::kNotApplicable) << told(law("momentum", r));
  for (const char* name : {"angular-momentum", "friction-cone", "unilateral"})
    expect_nothing_met(name, r, "points without impulses");
  EXPECT_EQ(law("contact-truth", r).outcome, core::Outcome::kPass) << told(law("contact-truth", r));
}

TEST(Momentum, MeetsNothingWhereNothingMoves) {
  expect_nothing_met("momentum", only_static(), "no step could be judged");
}

// An impulse of 1 N s across an arm of 1 m turns a body of 1 kg m^2 by 1 rad/s.
Specimen struck(double more) {
  Specimen r = one_step(1);
  end_step(r, [&](core::WideStates& s) { s.angular_velocity[0].z = 1 + more; });
  core::ContactPoint p;
  p.b = core::kFirstFace;
  p.point = {1, 0, 0};
  p.normal = {0, 1, 0};
  p.impulse = {0, 1, 0};
  add_point(r, p);
  return r;
}

TEST(AngularMomentum, AllowsTheRoundingOfPointAndState) {
  // 42 operations of L twice and of the moment, 2 u of point and arm, 4 u of the moment.
  expect_limit("angular-momentum", (126 + 4 + 4) * kU, struck, {"dL = (0, 0, 1", "sum (p - x) x J = (0, 0, 1) N m s"});
}

TEST(AngularMomentum, AllowsTheRoundingOfImpulsesThatAreTakenBack) {
  const auto stopped = [](double off) {
    Specimen r = struck(-1);
    r.header.scene.bodies[0].angular_velocity = {0, 0, -1};
    add_idle_step(r, [off](core::WideStates& s) { s.angular_velocity[0].z = off; });
    return r;
  };
  expect_limit("angular-momentum", 42 * kU, stopped, {"sum (p - x) x J = (0, 0, 0) N m s"});
}

TEST(AngularMomentum, AllowsTheRoundingOfACorrectionThatIsTakenBack) {
  const auto pushed = [](double off) {
    Specimen r = deep(struck(off - 1), "position");
    r.frames.back().points[0].impulse = {};
    return r;
  };
  expect_limit("angular-momentum", 42 * kU, pushed, {"sum (p - x) x J = (0, 0, 0) N m s"});
}

TEST(AngularMomentum, LeavesThePlaceInTheGapOpenForFrictionAlone) {
  const auto braked = [](double gap) {
    Specimen r = struck(0.05);
    r.frames[0].points[0].gap_m = static_cast<float>(gap);
    return law("angular-momentum", r).outcome;
  };
  EXPECT_EQ(braked(0.1), core::Outcome::kFail) << "along the normal no place in the gap has another moment";
  Specimen r = struck(0.05);
  r.frames[0].points[0].normal = {1, 0, 0};
  r.frames[0].points[0].gap_m = 0.1F;
  EXPECT_EQ(law("angular-momentum", r).outcome, core::Outcome::kPass);
}

TEST(AngularMomentum, MeetsNothingWithoutPoints) {
  Specimen r = struck(0);
  r.frames[0].points.clear();
  expect_nothing_met("angular-momentum", r, "no body with a reported point");
  r.header.groups &= ~core::bit(core::Group::kPoints);
  expect_nothing_met("angular-momentum", r, "the trace records no points of contact");
}

TEST(FrictionCone, EndsAtMu) {
  expect_limit("friction-cone", 0.5, [](double t) { return on_floor({}, {}, single(t, 1, 0)); },
               {"along the normal 1, across 0.55"});
}

TEST(FrictionCone, LetsNoContactPull) {
  const core::Verdict v = law("friction-cone", on_floor({}, {}, {0, -1e-6F, 0}));
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NE(v.origin.find("contacts push"), std::string::npos) << told(v);
  EXPECT_NE(v.explanation.find("along the normal -1e-06"), std::string::npos) << told(v);
}

// A body slides along x at 4 m/s, and friction mu J n brakes it in a direction that is off.
Specimen slides(double drag, double angle) {
  const auto impulse = single(-drag * std::cos(angle), 1, -drag * std::sin(angle));
  return on_floor({4, 0, 0}, {4, 0, 0}, impulse);
}

TEST(FrictionCone, OpposesWhatSlides) {
  // Twice 2 g h: by so much the slip may have changed since friction acted. `chord` is that of a circle of 4 m/s.
  expect_limit("friction-cone", 4 * kG * kStep, [](double chord) { return slides(0.5, 2 * std::asin(chord / 8)); },
               {"friction (-0.4", "slides at (4, 0, 0) m/s"});
}

TEST(FrictionCone, TakesTheImpulseOfSubstepsForASum) {
  // What the point's own impulse changes comes on top: |J| / m, and on an arm of 1/2 m a spin of 1/2 m x 1/2 N s / 1 kg
  // m^2.
  const double own = std::sqrt(1.25) + 0.5 * 0.25;
  const auto in_substeps = [](double chord) {
    Specimen r = slides(0.5, 2 * std::asin(chord / 8));
    r.header.declaration = core::Declaration::of({{"precision", "f32"}, {"substeps", "8"}});
    return r;
  };
  expect_limit("friction-cone", 4 * kG * kStep + 2 * own, in_substeps, {"slides at (4, 0, 0) m/s"});
}

TEST(FrictionCone, DoesNotFallShortWhereSomethingSlides) {
  // mu J n, less the share 2 x 2 g h / 4 m/s that may belong to another direction: 0.4375 N s.
  EXPECT_EQ(law("friction-cone", slides(0.4376, 0)).outcome, core::Outcome::kPass);
  const core::Verdict v = law("friction-cone", slides(0.4374, 0));
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NE(v.origin.find("braked by mu_kinetic"), std::string::npos) << told(v);
}

TEST(FrictionCone, TakesAPyramidOnlyWhereItIsDeclared) {
  Specimen r = on_floor({}, {}, {0.7F, 1, 0});
  EXPECT_EQ(law("friction-cone", r).outcome, core::Outcome::kFail);
  r.header.declaration = core::Declaration::of({{"friction", "pyramid"}, {"precision", "f32"}});
  EXPECT_EQ(law("friction-cone", r).outcome, core::Outcome::kPass);
}

TEST(FrictionCone, MeetsNothingWithoutAnImpulse) {
  expect_nothing_met("friction-cone", on_floor({}, {}, {}), "no point of contact with an impulse");
}

TEST(Unilateral, AllowsWhatClosesWithinTheStep) {
  // The body falls at 1 m/s and is stopped by 1.125 N s: without that impulse the gap would have closed at that speed,
  // and gravity may add g h.
  expect_limit("unilateral", kStep * (1.125 + 0.125),
               [](double gap) {
                 return on_floor({0, -1, 0}, {}, {0, 1.125F, 0}, gap);
               },
               {"an impulse over a gap of", "closes at 1.125 m/s"});
}

TEST(Unilateral, AddsTheDeclaredMargin) {
  Specimen r = on_floor({}, {}, {0, 0.125F, 0}, 0.01);
  EXPECT_EQ(law("unilateral", r).outcome, core::Outcome::kFail);
  r.header.declaration = core::Declaration::of({{"contact_margin_m", "0.01"}, {"precision", "f32"}});
  EXPECT_EQ(law("unilateral", r).outcome, core::Outcome::kPass);
}

// A point half a meter below the center of a body that spins about z moves along the floor. Its speed toward the floor
// is zero at the start and at the end, but a turn by t takes it t^2 / 2 of the arm off the tangent along which that
// speed is measured.
TEST(Unilateral, AllowsWhatAnArcIsOffItsTangent) {
  constexpr double kArcSpin = 16.0;  // rad/s: a quarter of a radian a step
  const auto spinning = [](double gap) {
    Specimen r = on_floor({}, {}, {0, 0.125F, 0}, gap);
    r.header.scene.bodies[0].angular_velocity = {0, 0, static_cast<float>(kArcSpin)};
    r.frames.back().wide.angular_velocity[0].z = kArcSpin;
    r.frames.back().angular_velocity[0].z = static_cast<float>(kArcSpin);
    return r;
  };
  const double arc_m = 0.5 * (kArcSpin * kStep) * (kArcSpin * kStep) * 0.5;
  expect_limit("unilateral", kStep * (0.125 + 0.125) + arc_m, spinning);
}

// A point 2 m to one side of a body of 1 kg and 1 kg m^2 is 1/16 m deep. Pushing it out, which takes an impulse of
// 1/16 / (1 + 2 x 2) kg m, moves a point 2 m to the other side down by 2 x 2 - 1 times that.
TEST(Unilateral, AllowsWhereTheDeclaredCorrectionMovesTheBody) {
  const auto rocks = [](double gap, const char* correction, const char* rate) {
    Specimen r = on_floor({}, {}, {0, 0.125F, 0}, gap);
    r.header.declaration = core::Declaration::of(
        {{"precision", "f32"}, {"detection_at", "start"}, {"correction", correction}, {"correction_rate", rate}});
    r.frames.back().points[0].point.x = 2.0F;
    core::ContactPoint deep = r.frames.back().points[0];
    deep.point.x = -2.0F;
    deep.gap_m = -0.0625F;
    deep.impulse = {};
    add_point(r, deep);
    return r;
  };
  // Without its impulse, the point would close at (1 + 2 x 2) / 8 m/s, and gravity adds 1/8.
  const double closes = kStep * (0.625 + 0.125);
  const double pushed = 0.0625 * 3.0 / 5.0;
  expect_limit("unilateral", closes + pushed, [&](double gap) { return rocks(gap, "position", "1"); });
  expect_limit("unilateral", closes + 0.5 * pushed, [&](double gap) { return rocks(gap, "velocity", "0.5"); });
  expect_limit("unilateral", closes, [&](double gap) { return rocks(gap, "none", "1"); });
}

TEST(Unilateral, MeetsNothingWithoutAnImpulse) {
  expect_nothing_met("unilateral", on_floor({}, {}, {}, 1.0), "no point of contact with an impulse");
}

}  // namespace
}  // namespace broadside::tests
