// Bounds on the distance of cylinders from boxes, capsules and each other hold, and quick answers from them agree with
// the answers of patches.
#include "core/method/rigid/quick_rounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/method/rigid/end_patches.hpp"
#include "tests/core/method/rigid/cylinder_cases.hpp"
#include "tests/core/method/rigid/quick_cases.hpp"

namespace broadside::core {
namespace {

// Of a radius of about half a meter.
Subject small_cylinder(Draw& draw) {
  return cylinder(draw.between(0.25F, 0.45F), draw.between(0.15F, 0.4F), draw.below(3));
}
Subject small_body(Draw& draw, int kind) {
  if (kind == 0) return capsule(draw.between(0.2F, 0.35F), draw.between(0.1F, 0.3F), draw.below(3));
  if (kind == 1) return box({draw.between(0.2F, 0.4F), draw.between(0.2F, 0.4F), draw.between(0.2F, 0.4F)});
  return small_cylinder(draw);
}

TEST(RoundGap, EnclosesTheDistance) {
  Draw draw(2);
  int apart = 0;
  int overlapping = 0;
  for (int trial = 0; trial < 240; ++trial) {
    Subject a = small_cylinder(draw);
    Subject b = small_body(draw, trial % 3);
    // Every fourth pair has parallel and crossing faces, edges and axes.
    a.pose.q = trial % 4 == 0 ? draw.quarter_turns() : draw.turn();
    b.pose.q = trial % 4 == 0 ? draw.quarter_turns() : draw.turn();
    b.pose.x = draw.between(0.3F, 1.3F) * normalized(draw.in_cube(1.0F));
    const PlacedShape placed_a = placed_shape(a.shape, a.pose, a.pose.x);
    const PlacedShape placed_b = placed_shape(b.shape, b.pose, a.pose.x);
    const float rounding_m = contact_rounding_m(placed_a, placed_b);
    const HullGap gap = round_gap(placed_a, placed_b, 10.0F, 0x1p-6F, rounding_m);
    // Any direction bounds the distance from below, and the search for the widest one is no exact one.
    const double along = gap_along(a, b, exact::to_point(gap.normal));
    const double widest = std::max(widest_gap(a, b), along);
    EXPECT_NEAR(gap.least_m, along, rounding_m) << trial;
    EXPECT_GE(gap.most_m, widest - rounding_m) << trial;
    EXPECT_LE(gap.overlap_m, rounding_m - widest) << trial;
    EXPECT_NEAR(length(gap.normal), 1.0F, 1e-6F);
    if (widest > 0.01) {
      ++apart;
      EXPECT_LE(gap.most_m - gap.least_m, 0x1p-5F * gap.most_m) << "they did not meet, trial " << trial;
    }
    if (widest < -0.01) {
      ++overlapping;
      EXPECT_LT(gap.most_m, 0.01F) << trial;
    }
  }
  EXPECT_GT(apart, 60);
  EXPECT_GT(overlapping, 60);
}

TEST(QuickRounds, TellWhatPatchesTell) {
  Draw draw(3);
  for (int kind = 0; kind < 3; ++kind) {
    const QuickCounts counts = compare_quick_answers(
        draw, 300, [&draw](int) { return small_cylinder(draw); }, [&draw, kind](int) { return small_body(draw, kind); },
        [](const Subject& a, const ContactPose& at_a, const Subject& b, const ContactPose& at_b, float seen_m) {
          EXPECT_TRUE(has_round_answers(a.shape, b.shape));
          EXPECT_TRUE(has_round_answers(b.shape, a.shape));
          return round_bounds(a.shape, at_a, b.shape, at_b, seen_m);
        });
    expect_most_are_quick(counts);
  }
}

// Where nothing overlaps at the end of a step, its patches are not looked for, and none would have been added.
TEST(QuickRounds, EndsThatAreApartHaveNoPatches) {
  Draw draw(5);
  int apart = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Subject a = small_cylinder(draw);
    const Subject b = small_body(draw, trial % 3);
    const ContactPose at_a{{}, draw.turn()};
    const ContactPose at_b{draw.between(0.5F, 1.0F) * normalized(draw.in_cube(1.0F)), draw.turn()};
    const float unseen = unseen_m(a.shape, b.shape);
    if (!surely_apart(round_bounds(a.shape, at_a, b.shape, at_b, -unseen), -unseen)) continue;
    ++apart;
    Manifold end[kPatchesOfPair];
    EXPECT_EQ(make_manifolds(a.shape, at_a, b.shape, at_b, -unseen, end), 0) << trial;
  }
  EXPECT_GT(apart, 50);
  EXPECT_LT(apart, 290);
}

TEST(QuickRounds, AreForCylindersAgainstClosedForms) {
  const ContactShape of_box = box({0.5F, 0.5F, 0.5F}).shape;
  const ContactShape of_ball = sphere(0.5F).shape;
  const ContactShape of_cylinder = cylinder(0.5F, 0.5F, 1).shape;
  const ContactShape of_capsule = capsule(0.5F, 0.5F, 1).shape;
  EXPECT_FALSE(has_round_answers(of_box, of_capsule)) << "neither is a cylinder";
  EXPECT_FALSE(has_round_answers(of_ball, of_cylinder)) << "its patch is one formula";
  EXPECT_TRUE(has_round_answers(of_capsule, of_cylinder));
}

}  // namespace
}  // namespace broadside::core
