// A step that is taken in parts, as one frame.
#include "core/method/rigid/step_in_parts.hpp"

#include <gtest/gtest.h>

#include "core/contact.hpp"

namespace broadside::core {
namespace {

TEST(StepInParts, MassesOfWhatMovesAreCompared) {
  Scene scene;
  EXPECT_EQ(largest_mass_ratio(scene), 1.0F);
  for (const float inverse : {0.0F, 2.0F, 0.25F, 1.0F}) scene.bodies.emplace_back().inverse_mass = inverse;
  EXPECT_EQ(largest_mass_ratio(scene), 8.0F);
  const SoftSettings settings;
  EXPECT_EQ(plan_of_step(settings, 64.0F, false, 0.0F, false).parts, 1U);
  EXPECT_EQ(plan_of_step(settings, 65.0F, false, 0.0F, false).parts, 4U);
  EXPECT_EQ(plan_of_step(settings, 65.0F, true, 9.0F, false).parts, 1U);
  // Its cost must be known in advance.
  EXPECT_EQ(most_parts(soft_step_settings(), 1000.0F, true), 1U);
  EXPECT_EQ(most_parts(soft_step_settings(), 1.0F, true), 1U);
}

TEST(StepInParts, NoBodyMovesFarForItsThicknessInOneOfThem) {
  const SoftSettings settings;
  const auto parts = [&](float stride) { return plan_of_step(settings, 1.0F, false, stride, false).parts; };
  EXPECT_EQ(parts(0.25F), 1U);
  EXPECT_EQ(parts(0.26F), 2U);
  EXPECT_EQ(parts(0.5F), 2U);
  EXPECT_EQ(parts(0.51F), 4U);
  EXPECT_EQ(parts(1e9F), 4U);
  EXPECT_EQ(plan_of_step(settings, 1.0F, true, 9.0F, false).parts, 1U);
  // The parts share the substeps of the step.
  for (const float stride : {0.1F, 0.3F, 2.0F}) {
    const StepPlan plan = plan_of_step(settings, 1.0F, false, stride, false);
    EXPECT_EQ(plan.parts * solve_numbers(settings, SolveKind::kEven, plan).substeps, settings.even.substeps);
  }
  // Where masses differ much, each part has all substeps.
  EXPECT_EQ(solve_numbers(settings, SolveKind::kEven, plan_of_step(settings, 65.0F, false, 0.0F, false)).substeps,
            settings.even.substeps);
}

// Where the ways of bodies are followed (swept), a step has more parts.
TEST(StepInParts, NoFollowedBodyMovesFarInOneOfThem) {
  const SoftSettings settings;
  const auto plan = [&](float ratio, bool is_calm, float stride) {
    return plan_of_step(settings, ratio, is_calm, stride, true);
  };
  EXPECT_EQ(plan(1.0F, false, 0.25F).parts, 1U);
  EXPECT_EQ(plan(1.0F, false, 1.1F).parts, 8U);
  EXPECT_EQ(plan(1.0F, false, 1e9F).parts, 16U);
  EXPECT_EQ(plan(1.0F, true, 1e9F).parts, 1U);
  EXPECT_EQ(most_parts(settings, 1.0F, true), 16U);
  // Where masses differ much, there are four parts in any case, with four substeps in each.
  for (const float stride : {0.0F, 1.0F, 1.1F, 9.0F}) {
    const StepPlan uneven = plan(65.0F, false, stride);
    EXPECT_EQ(uneven.parts, stride > 2.0F ? 16U : (stride > 1.0F ? 8U : 4U));
    EXPECT_EQ(uneven.parts * solve_numbers(settings, SolveKind::kUneven, uneven).substeps, 16U);
  }
  EXPECT_EQ(plan(65.0F, true, 9.0F).parts, 1U);
  EXPECT_EQ(most_of_step(settings, 1.0F, true, true).substeps, 16U);
  EXPECT_EQ(most_of_step(settings, 1.0F, true, false).substeps, 4U);
}

// One body, which in the second part is a meter further along x and a quarter turn about y further.
FrameRecord part_of(bool is_first) {
  FrameRecord frame;
  frame.digest = is_first ? 1 : 2;
  frame.detected_position = {is_first ? Vec3{0, 1, 0} : Vec3{1, 1, 0}};
  frame.detected_velocity = {Vec3{}};
  frame.detected_orientation = {is_first ? Quat{1, 0, 0, 0} : Quat{0.70710678F, 0, 0.70710678F, 0}};
  frame.boxes = {Box{{is_first ? 0.0F : 1.0F, 0, 0}, {2, 2, 2}}};
  frame.position = {Vec3{2, 1, 0}};
  frame.orientation = frame.detected_orientation;
  frame.velocity = frame.angular_velocity = {Vec3{1, 0, 0}};
  return frame;
}

ContactPoint point_on_floor(Vec3 point, float gap_m, float push_n_s) {
  return {0, kFirstFace + 2, point, {0, 1, 0}, gap_m, {0, push_n_s, 0}, 7};
}

TEST(StepInParts, PointsOfPartsAreToldWhereTheirSurfacesWereAtTheStart) {
  FrameRecord first = part_of(true);
  first.points = {point_on_floor({0.5F, 0.01F, 0}, 0.02F, 1.0F)};
  FrameRecord last = part_of(false);
  // A corner that was at x = 0.5 from the center has come to z = -0.5.
  last.points = {point_on_floor({1, -0.01F, -0.5F}, -0.02F, 2.0F)};
  StepInParts step;
  step.begin();
  step.add(first);
  step.join(last, RecordLevel::kFull);
  ASSERT_EQ(last.points.size(), 2U);
  EXPECT_EQ(last.points[0].impulse.y, 1.0F);
  EXPECT_EQ(last.points[1].impulse.y, 2.0F);
  EXPECT_NEAR(last.points[1].point.x, 0.5F, 1e-6F);
  EXPECT_NEAR(last.points[1].point.z, 0.0F, 1e-6F);
  // The floor's height is 0; as deep as the points that were found at the start, and no deeper than one that was not.
  EXPECT_EQ(last.points[1].gap_m, 0.0F);
  EXPECT_EQ(last.boxes[0].min.x, 0.0F);
  EXPECT_EQ(last.position[0].x, 2.0F);
  EXPECT_NE(last.digest, 2U);
}

TEST(StepInParts, PosesBetweenPartsAreTold) {
  FrameRecord last = part_of(false);
  StepInParts step;
  step.join(last, RecordLevel::kFull);
  EXPECT_TRUE(last.part_poses.empty()) << "it was taken at once";
  FrameRecord middle = part_of(false);
  middle.position = {Vec3{1.5F, 1, 0}};
  step.add(part_of(true));
  step.add(middle);
  step.join(last, RecordLevel::kFull);
  ASSERT_EQ(last.part_poses.size(), 2U);
  EXPECT_EQ(last.part_poses[0].position, (Vec3{2, 1, 0}));
  EXPECT_EQ(last.part_poses[1].position, (Vec3{1.5F, 1, 0}));
  EXPECT_EQ(last.part_poses[1].orientation, middle.orientation[0]);
}

// A body at rest is struck in the second part by one that has moved 2 m sideways by then: the impulse is recorded at
// the place where the body at rest was struck.
TEST(StepInParts, APointIsToldWhereWhatMovedLessWas) {
  const auto of = [](bool is_first) {
    FrameRecord frame;
    frame.detected_position = {Vec3{}, is_first ? Vec3{-2, 1, 0} : Vec3{0, 1, 0}};
    frame.detected_velocity = frame.velocity = frame.angular_velocity = {Vec3{}, Vec3{}};
    frame.detected_orientation = frame.orientation = {Quat{}, Quat{}};
    frame.boxes.resize(2);
    frame.position = frame.detected_position;
    return frame;
  };
  FrameRecord last = of(false);
  last.points = {{0, 1, {0.25F, 0.5F, 0}, {0, -1, 0}, 0.0F, {0, -1, 0}, 7}};
  StepInParts step;
  step.add(of(true));
  step.join(last, RecordLevel::kFull);
  EXPECT_EQ(last.points[0].point, (Vec3{0.25F, 0.5F, 0}));
  EXPECT_EQ(last.points[0].gap_m, 0.0F);
}

TEST(StepInParts, ADigestIsThatOfTheWholeStep) {
  FrameRecord full = part_of(false);
  FrameRecord told = part_of(false);
  StepInParts step;
  step.add(part_of(true));
  step.join(full, RecordLevel::kFull);
  step.join(told, RecordLevel::kDigest);
  EXPECT_EQ(told.digest, full.digest);
  EXPECT_TRUE(told.position.empty());
}

}  // namespace
}  // namespace broadside::core
