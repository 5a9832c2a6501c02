// contact-truth, penetration, passage, energy-growth and rest: the laws about where bodies are, and about the energy of
// their motion.
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "core/contact.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "tests/validation/mechanics/one_step.hpp"

namespace broadside::tests {
namespace {

using bench::Specimen;

// By how much one step of gravity brings two bodies at rest closer together: h^2 g each.
constexpr double kApproach = 2 * kG * kStep * kStep;

// A box on another one, that deep.
Specimen overlapping(double depth) {
  Specimen r = one_step(2);
  r.header.scene.bodies[1].position = {0, static_cast<float>(1 - depth), 0};
  r.header.groups |= core::bit(core::Group::kPoints);
  end_step(r, [](core::WideStates&) {});
  return r;
}

// A is the lower one, so the normal points down.
core::ContactPoint point_between(double depth) {
  core::ContactPoint p;
  p.a = 0;
  p.b = 1;
  p.point = {0, static_cast<float>(0.5 - 0.5 * depth), 0};
  p.normal = {0, -1, 0};
  p.gap_m = static_cast<float>(-depth);
  return p;
}

TEST(ContactTruth, AsksForAPointWhereBodiesOverlap) {
  // h^2 g for both, counted once for the two, and 16 u of their size.
  expect_limit("contact-truth", 0.5 * kApproach, overlapping, {"the exact distance is -0.00", "no point is reported"});
}

TEST(ContactTruth, TakesTheGapOfTheExactShapes) {
  const auto told_deeper = [](double more) {
    Specimen r = overlapping(0.25);
    core::ContactPoint p = point_between(0.25);
    p.gap_m -= static_cast<float>(more);
    add_point(r, p);
    return r;
  };
  EXPECT_EQ(law("contact-truth", told_deeper(0)).outcome, core::Outcome::kPass)
      << told(law("contact-truth", told_deeper(0)));
  expect_limit("contact-truth", 0.5 * kApproach, told_deeper, {"1 points are"});
  expect_limit("contact-truth", 0.5 * kApproach, [&](double less) { return told_deeper(-less); });
}

TEST(ContactTruth, TakesTheNormalOfLeastDepthAlone) {
  for (const core::Vec3 n : {core::Vec3{0, 1, 0}, core::Vec3{1, 0, 0}, core::Vec3{0.6F, -0.8F, 0}}) {
    Specimen r = overlapping(0.25);
    core::ContactPoint p = point_between(0.25);
    p.normal = n;
    add_point(r, p);
    const core::Verdict v = law("contact-truth", r);
    EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
    EXPECT_EQ(v.worst.field, "points.normal");
  }
}

TEST(ContactTruth, TakesNoPointBesideTheBodies) {
  Specimen r = overlapping(0.25);
  core::ContactPoint p = point_between(0.25);
  p.point.x = 0.85F;
  add_point(r, p);
  const core::Verdict v = law("contact-truth", r);
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NE(v.explanation.find("0.35 m outside body"), std::string::npos) << told(v);
}

TEST(ContactTruth, AsksForAPointBeyondAFace) {
  Specimen r = one_step(1);
  r.header.scene.domain.min.y = -0.25F;
  r.header.groups |= core::bit(core::Group::kPoints);
  end_step(r, [](core::WideStates&) {});
  const core::Verdict v = law("contact-truth", r);
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NE(v.explanation.find("the body is 0.25 m beyond the face"), std::string::npos) << told(v);
}

TEST(ContactTruth, MeetsNothingWhereNothingIsNear) {
  Specimen r = one_step(1);
  r.header.groups |= core::bit(core::Group::kPoints);
  end_step(r, [](core::WideStates&) {});
  expect_nothing_met("contact-truth", r, "no two bodies with convex shapes came near");
}

TEST(Penetration, EndsAtHalfOfTheSmallerBody) {
  const auto sunk = [](double depth) {
    Specimen r = overlapping(0);
    r.frames[0].wide.position[1].y -= depth;
    return r;
  };
  expect_limit("penetration", 0.5, sunk, {"% of the smaller body", "class below C"});
}

TEST(Penetration, LeavesAloneWhatTheScenePutDeeper) {
  Specimen r = overlapping(0.7);
  EXPECT_EQ(law("penetration", r).outcome, core::Outcome::kPass) << told(law("penetration", r));
  r.frames[0].wide.position[1].y -= 0.1;
  EXPECT_EQ(law("penetration", r).outcome, core::Outcome::kFail) << told(law("penetration", r));
}

TEST(Penetration, IsThatOfTheGroundToo) {
  expect_limit("penetration", 0.5,
               [](double depth) {
                 Specimen r = one_step(1);
                 r.header.scene.domain.min.y = -1.0F;
                 end_step(r, [&](core::WideStates& s) { s.position[0].y = -0.5 - depth; });
                 return r;
               },
               {"the -y face"});
}

TEST(Penetration, NamesTheClass) {
  const auto class_of = [](double depth) { return law("penetration", overlapping(depth)).explanation; };
  EXPECT_NE(class_of(0.9 * kApproach).find("class A"), std::string::npos) << class_of(0.9 * kApproach);
  EXPECT_NE(class_of(0.04).find("class B"), std::string::npos) << class_of(0.04);
  EXPECT_NE(class_of(0.06).find("class C"), std::string::npos) << class_of(0.06);
}

TEST(Penetration, MeetsNothingWhereNothingIsNear) {
  Specimen r = one_step(1);
  end_step(r, [](core::WideStates&) {});
  expect_nothing_met("penetration", r, "no body with a convex shape came near");
}

// A ball of radius 1/2 flies over a box, with its lowest point that far below the box's top.
Specimen passes(double depth, double way = 8.0) {
  Specimen r = one_step(2);
  r.header.scene.gravity_m_s2 = {};
  r.header.scene.meshes.push_back(ball(0.5));
  r.header.scene.bodies[0].inverse_mass = 0.0F;
  r.header.scene.bodies[1].mesh = 1;
  r.header.scene.bodies[1].position = {-4, static_cast<float>(1 - depth), 0};
  r.header.scene.bodies[1].velocity = {static_cast<float>(way / kStep), 0, 0};
  end_step(r, [&](core::WideStates& s) { s.position[1].x += way; });
  return r;
}

TEST(Passage, FindsWhatIsDeepBetweenTwoFrames) {
  // The limit is half of the smaller side of 1 m; an eighth more of it may go unseen.
  EXPECT_EQ(law("passage", passes(0.45)).outcome, core::Outcome::kPass) << told(law("passage", passes(0.45)));
  const core::Verdict v = law("passage", passes(0.6));
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_DOUBLE_EQ(v.limit, 0.5);
  EXPECT_NE(v.explanation.find("m at the two ends, and 0."), std::string::npos) << told(v);
  EXPECT_EQ(law("passage", passes(1.0)).outcome, core::Outcome::kFail);
}

// A cube of 1 m with a dent in its top, cut into quarters: no convex shape. It falls through a plate, or past
// its edge.
Specimen falls(bool hits, bool plate_is_dented = false) {
  const auto dented = [](std::array<double, 3> sides) {
    core::Mesh mesh = datasets::box_mesh(sides, {2, 2, 2}).value();
    for (core::Vec3& v : mesh.vertices)
      if (v.x == 0.0F && v.z == 0.0F && v.y > 0.0F) v.y *= 0.5F;
    return std::make_shared<const core::Mesh>(std::move(mesh));
  };
  Specimen r = one_step(2);
  r.header.scene.gravity_m_s2 = {};
  r.header.scene.meshes.push_back(dented({1, 1, 1}));
  r.header.scene.meshes.push_back(
      plate_is_dented ? dented({4, 0.2, 4})
                      : std::make_shared<const core::Mesh>(datasets::box_mesh({4, 0.2, 4}, {1, 1, 1}).value()));
  r.header.scene.bodies[0].inverse_mass = 0.0F;
  r.header.scene.bodies[0].mesh = 2;
  r.header.scene.bodies[1].mesh = 1;
  r.header.scene.bodies[1].position = {hits ? 0.0F : 5.5F, 3, 0};
  r.header.scene.bodies[1].velocity = {hits ? 0.0F : static_cast<float>(-3.5 / kStep), static_cast<float>(-6 / kStep),
                                       0};
  end_step(r, [&](core::WideStates& s) {
    s.position[1].x -= hits ? 0.0 : 3.5;
    s.position[1].y -= 6;
  });
  return r;
}

TEST(Passage, OfAMeshGoesByItsVertices) {
  const core::Verdict v = law("passage", falls(true));
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NEAR(v.limit, 0.05, 1e-7) << "a quarter of the plate's thickness";
  EXPECT_EQ(law("passage", falls(false)).outcome, core::Outcome::kPass) << told(law("passage", falls(false)));
}

TEST(Passage, OfTwoMeshesGoesByTheArbiter) {
  EXPECT_EQ(law("passage", falls(false, true)).outcome, core::Outcome::kPass)
      << told(law("passage", falls(false, true)));
  EXPECT_EQ(law("passage", falls(true, true)).outcome, core::Outcome::kInconclusive)
      << told(law("passage", falls(true, true)));
}

TEST(Passage, MeetsNothingThatIsSlow) {
  expect_nothing_met("passage", passes(0.45, 0.25), "fast enough");
}

TEST(EnergyGrowth, AllowsTheDifferenceOfExplicitAndImplicitSteps) {
  // 1/2 m g^2 h^2, all of it as speed.
  expect_limit("energy-growth", 0.5 * kG * kG * kStep * kStep,
               [](double more) {
                 Specimen r = one_step(1);
                 end_step(r, [&](core::WideStates& s) { s.velocity[0].x = std::sqrt(2 * more); });
                 return r;
               },
               {"the energy of 1 bodies that may touch changed by"});
}

TEST(EnergyGrowth, AllowsADeclaredCorrectionItsLift) {
  const auto lifted = [](const std::string& correction) {
    Specimen r = overlapping(0.25);
    r.header.declaration = core::Declaration::of(
        {{"correction", correction}, {"correction_rate", "1"}, {"detection_at", "start"}, {"precision", "f32"}});
    add_point(r, point_between(0.25));
    r.frames[0].wide.position[1].y += 0.2;
    return law("energy-growth", r);
  };
  EXPECT_EQ(lifted("position").outcome, core::Outcome::kPass) << told(lifted("position"));
  EXPECT_EQ(lifted("none").outcome, core::Outcome::kFail) << told(lifted("none"));
}

// 1 m/s, 1/2 J, and 0.03 J more: with an accuracy of 1 % speeds may be off by that, and energy by 2 % of what there is.
TEST(EnergyGrowth, AllowsTheAccuracyOfErrorControl) {
  const auto sped_up = [](const std::string& accuracy) {
    Specimen r = one_step(1);
    r.header.declaration = core::Declaration::of({{"accuracy", accuracy}, {"precision", "f32"}});
    r.header.scene.bodies[0].velocity = {1, 0, 0};
    end_step(r, [](core::WideStates& s) { s.velocity[0].x = std::sqrt(1.06); });
    return law("energy-growth", r);
  };
  EXPECT_EQ(sped_up("0.01").outcome, core::Outcome::kPass) << told(sped_up("0.01"));
  EXPECT_EQ(sped_up("0.001").outcome, core::Outcome::kFail) << told(sped_up("0.001"));
}

// 64 N on 1 kg: in steps of 1/64 s the speed rises by 1 m/s each, or by `gain` times that. Contacts are declared to be
// springs, which may give back what they stored, and nothing more.
Specimen pushed_for_twelve_steps(double gain) {
  Specimen r = one_step(1);
  r.header.declaration = core::Declaration::of({{"contact_model", "compliant"}, {"precision", "f32"}});
  r.header.scene.gravity_m_s2 = {};
  r.header.scene.wrenches = {{0, core::WrenchAxes::kWorld, {64, 0, 0}, {}}};
  double x = 0.0;
  for (int k = 1; k <= 12; ++k) {
    x += gain * k * kStep;
    core::FrameRecord& frame = end_step(r, [&](core::WideStates& s) {
      s.velocity[0].x = gain * k;
      s.position[0].x = x;
    });
    frame.step = static_cast<std::uint64_t>(k);
    frame.time_s = k * kStep;
  }
  return r;
}

// The work of all earlier steps counts, not that of the last step alone: once, a scene with a wrench failed from its
// second step on.
TEST(EnergyGrowth, OfCompliantContactsLeavesOutTheWorkOfWrenches) {
  const core::Verdict right = law("energy-growth", pushed_for_twelve_steps(1.0));
  EXPECT_EQ(right.outcome, core::Outcome::kPass) << told(right);
  const core::Verdict twice = law("energy-growth", pushed_for_twelve_steps(2.0));
  EXPECT_EQ(twice.outcome, core::Outcome::kFail) << told(twice);
}

TEST(EnergyGrowth, MeetsNothingWhereNothingMoves) {
  expect_nothing_met("energy-growth", only_static(), "no step of a moving body");
}

Specimen stands(double moved) {
  Specimen r = one_step(1);
  r.header.scene.answer = "stands";
  end_step(r, [&](core::WideStates& s) { s.position[0].x = moved; });
  return r;
}

TEST(Rest, AllowsAHundredthOfTheSmallestSide) {
  expect_limit("rest", 0.01 * (1 + kStep / 60), stands, {"the body has moved by (0.011, 0, 0) m"});
}

TEST(Rest, SeesAMillimeterASecond) {
  Specimen r = stands(0);
  for (std::uint64_t step = 2; step <= 256; ++step) {
    core::FrameRecord frame = r.frames.back();
    frame.step = step;
    frame.wide.position[0].x = 1e-3 * kStep * static_cast<double>(step);
    r.frames.push_back(frame);
  }
  const core::Verdict v = law("rest", r);
  EXPECT_EQ(v.outcome, core::Outcome::kFail) << told(v);
  EXPECT_NE(v.explanation.find("it has crept at 0.001 m/s"), std::string::npos) << told(v);
}

TEST(Rest, IsAskedOfScenesThatStandAlone) {
  Specimen r = one_step(1);
  end_step(r, [](core::WideStates&) {});
  expect_nothing_met("rest", r, "is not one that must stand");
}

// A cube at rest is struck by one at 64 m/s, strikes a fixed one `gap` away, and is back in its place when the step
// ends: its boxes at the two ends are equal.
bench::Specimen struck_back(double gap, const char* substeps, bool is_struck) {
  bench::Specimen r = one_step(3, {1000.0, 1000.0, 1000.0});
  r.header.declaration =
      core::Declaration::of({{"precision", "f32"}, {"detection_at", "start"}, {"substeps", substeps}});
  auto& bodies = r.header.scene.bodies;
  for (core::Body& b : bodies) b.material = {};
  bodies[0].position = {-1, 0, 0};
  bodies[0].velocity = {64, 0, 0};
  bodies[2].position = {1.0F + static_cast<float>(gap), 0, 0};
  bodies[2].inverse_mass = 0.0F;
  end_step(r, [](core::WideStates& s) { s.velocity[0].x = 0; });
  add_point(r, {0, 1, {-0.5F, 0, 0}, {-1, 0, 0}, 0.0F, {is_struck ? -64.0F : 0.0F, 0, 0}, 1});
  add_point(r, {1, 2, {0.5F, 0, 0}, {-1, 0, 0}, static_cast<float>(gap), {-64, 0, 0}, 1});
  return r;
}

// h (g h + J / m sqrt(1 + mu^2)) for its center, and as little as it turns; mu is 0.6, the default of surfaces.
TEST(ContactTruth, BodiesThatOthersDroveTogetherWithinTheStepMayHaveMet) {
  const double way_m = kStep * (kG * kStep + 64.0 * std::sqrt(1.36));
  const auto outcome = [](double gap, const char* substeps, bool is_struck) {
    return law("contact-truth", struck_back(gap, substeps, is_struck)).outcome;
  };
  EXPECT_EQ(outcome(0.99 * way_m, "4", true), core::Outcome::kPass)
      << told(law("contact-truth", struck_back(0.99 * way_m, "4", true)));
  EXPECT_EQ(outcome(1.01 * way_m, "4", true), core::Outcome::kFail) << "farther than anything drove it";
  EXPECT_EQ(outcome(0.5 * way_m, "4", false), core::Outcome::kFail) << "what they gave each other drove nobody there";
  EXPECT_EQ(outcome(0.5 * way_m, "1", true), core::Outcome::kFail) << "one step of one solve meets at its ends";
}

}  // namespace
}  // namespace broadside::tests
