// Bounds on the distance of hulls hold, and quick answers from them agree with the answers of patches.
#include "core/method/rigid/quick_hulls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/exact/convex_hull.hpp"
#include "core/method/rigid/end_patches.hpp"
#include "core/method/rigid/hull_climb.hpp"
#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"
#include "tests/core/method/rigid/quick_cases.hpp"

namespace broadside::core {
namespace {

// Of a radius of about half a meter, flatter by up to a third.
Subject boulder(Draw& draw, int corners) {
  const Vec3 half{draw.between(0.35F, 0.5F), draw.between(0.35F, 0.5F), draw.between(0.35F, 0.5F)};
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) {
    const Vec3 p = normalized(draw.in_cube(1.0F));
    points.push_back({half.x * p.x, half.y * p.y, half.z * p.z});
  }
  return hull(*exact::convex_hull(points));
}

TEST(HullClimb, EndsAtTheLowestCorner) {
  Draw draw(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Subject s = boulder(draw, 30 + draw.below(200));
    const HullView& view = s.shape.hull;
    for (int k = 0; k < 50; ++k) {
      const Vec3 direction = normalized(draw.in_cube(1.0F));
      float least = 1e30F;
      for (std::uint32_t v = 0; v < view.vertex_count; ++v) least = std::min(least, dot(direction, view.vertices[v]));
      const std::uint32_t low = climb_down(view, direction, climb_start(view, direction));
      EXPECT_NEAR(dot(direction, view.vertices[low]), least, 4.0F * 0x1p-24F * s.shape.size_m);
      const std::uint32_t from_anywhere = climb_down(view, direction, static_cast<std::uint32_t>(draw.below(10)));
      EXPECT_NEAR(dot(direction, view.vertices[from_anywhere]), least, 4.0F * 0x1p-24F * s.shape.size_m);
    }
  }
}

TEST(HullGap, EnclosesTheDistance) {
  Draw draw(2);
  int apart = 0;
  int overlapping = 0;
  for (int trial = 0; trial < 120; ++trial) {
    Subject a = boulder(draw, 40);
    Subject b = boulder(draw, 40);
    a.pose.q = draw.turn();
    b.pose.q = draw.turn();
    b.pose.x = draw.between(0.3F, 1.3F) * normalized(draw.in_cube(1.0F));
    const PlacedShape placed_a = placed_shape(a.shape, a.pose, a.pose.x);
    const PlacedShape placed_b = placed_shape(b.shape, b.pose, a.pose.x);
    const float rounding_m = contact_rounding_m(placed_a, placed_b);
    const HullGap gap = hull_gap({a.shape.hull, placed_a.center, placed_a.axes},
                                 {b.shape.hull, placed_b.center, placed_b.axes}, 10.0F, 0x1p-10F, rounding_m);
    const double truth = exact::signed_distance(a.placed(), b.placed()).distance_m;
    EXPECT_LE(gap.least_m, truth + rounding_m) << trial;
    EXPECT_GE(gap.most_m, std::max(truth, 0.0) - rounding_m) << trial;
    EXPECT_LE(gap.overlap_m, -truth + rounding_m) << trial;
    EXPECT_NEAR(length(gap.normal), 1.0F, 1e-6F);
    const double along = -exact::overlap_along(a.placed(), b.placed(), exact::to_point(gap.normal));
    EXPECT_NEAR(gap.least_m, along, rounding_m) << trial;
    if (truth > 0.01) {
      ++apart;
      EXPECT_LE(gap.most_m - gap.least_m, 0x1p-9F * gap.most_m) << "they did not meet, trial " << trial;
    }
    if (truth < -0.01) {
      ++overlapping;
      EXPECT_EQ(gap.most_m, 0.0F) << trial;
    }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(overlapping, 30);
}

// A search that is stopped at a bound and continued later ends with the same result as one that was never stopped.
TEST(HullGap, GoesOnFromABoundToTheSameBits) {
  Draw draw(31);
  int unfinished = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Subject a = boulder(draw, 60);
    Subject b = boulder(draw, 60);
    a.pose.q = draw.turn();
    b.pose = {draw.between(0.6F, 1.3F) * normalized(draw.in_cube(1.0F)), draw.turn()};
    const HullPair pair = hull_pair(a.shape, a.pose, b.shape, b.pose);
    HullSearch search = begin_search(pair.a, pair.b, {});
    (void)hull_bounds(pair, search, draw.between(-0.1F, 0.3F));
    unfinished += search.has_ended ? 0 : 1;
    const NearestOfHulls gone_on = exact_hull_gap(pair.a, pair.b, search, pair.rounding_m);
    const NearestOfHulls at_once = exact_hull_gap(pair.a, pair.b, pair.rounding_m);
    EXPECT_EQ(gone_on.gap.normal, at_once.gap.normal) << trial;
    EXPECT_EQ(gone_on.gap.least_m, at_once.gap.least_m) << trial;
    EXPECT_EQ(gone_on.gap.most_m, at_once.gap.most_m) << trial;
    ASSERT_EQ(gone_on.corners.count, at_once.corners.count) << trial;
    for (int k = 0; k < gone_on.corners.count; ++k) EXPECT_EQ(gone_on.corners.weights[k], at_once.corners.weights[k]);
  }
  EXPECT_GT(unfinished, 50);
}

// Two boulders that turn and come near each other within a step.
struct Meeting {
  Subject a;
  Subject b;
  ContactPath path_a;
  ContactPath path_b;
  float reach_m = 0.0F;
};
Meeting meeting(Draw& draw) {
  Meeting m{boulder(draw, 60), boulder(draw, 60), {}, {}};
  m.path_a = {{{}, draw.turn()}, {draw.in_cube(0.1F), draw.turn()}};
  m.path_b.start = {draw.between(0.7F, 1.2F) * normalized(draw.in_cube(1.0F)), draw.turn()};
  m.path_b.end = {m.path_b.start.x + draw.in_cube(0.1F), draw.turn()};
  m.reach_m = length(m.path_a.end.x) + length(m.path_b.end.x - m.path_b.start.x);
  return m;
}

bool is_same(const Manifold& a, const Manifold& b) {
  if (a.count != b.count || !(a.normal == b.normal)) return false;
  for (int k = 0; k < a.count; ++k)
    if (!(a.points[k].point == b.points[k].point) || a.points[k].gap_m != b.points[k].gap_m ||
        a.points[k].feature != b.points[k].feature)
      return false;
  return true;
}

// A caller that hands in known gaps gets the same patches, bit by bit.
TEST(QuickHulls, KnownGapsChangeNoPatch) {
  Draw draw(17);
  int patches = 0;
  int passing = 0;
  int added = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Meeting m = meeting(draw);
    const ContactShape& a = m.a.shape;
    const ContactShape& b = m.b.shape;
    KnownGaps gaps;
    const PairAhead ahead{.reach_m = m.reach_m, .near = {}, .swing_m = 1.0F, .may_pass = trial % 2 == 0};
    if (surely_passes(a, m.path_a, b, m.path_b, ahead, gaps)) continue;
    ASSERT_TRUE(gaps.are_known);
    Manifold plain[kPatchesOfPair];
    Manifold known[kPatchesOfPair];
    const int count = make_manifolds(a, m.path_a.start, b, m.path_b.start, m.reach_m, plain);
    ASSERT_EQ(make_manifolds(a, m.path_a.start, b, m.path_b.start, m.reach_m, known, &gaps.start), count);
    if (count == 0) continue;
    ++patches;
    EXPECT_TRUE(is_same(plain[0], known[0])) << trial;
    const bool passes = passes_by(plain[0], a, m.path_a, b, m.path_b, m.reach_m, 0.0F);
    passing += passes ? 1 : 0;
    const int all = add_end_patches(a, m.path_a, b, m.path_b, 1.0F, plain, count);
    ASSERT_EQ(add_end_patches(a, m.path_a, b, m.path_b, 1.0F, known, count, &gaps), all) << trial;
    for (int k = 0; k < all; ++k) EXPECT_TRUE(is_same(plain[k], known[k])) << trial;
    added += all - count;
  }
  EXPECT_GT(patches, 50);
  EXPECT_GT(passing, 10);
  EXPECT_GT(added, 10);
}

// A lane that leaves hard pairs to others makes the same patches for all remaining pairs, and leaves few.
TEST(QuickHulls, ALaneOfHullsLeavesFewPairs) {
  Draw draw(23);
  int made = 0;
  int left = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Meeting m = meeting(draw);
    const ContactShape& a = m.a.shape;
    const ContactShape& b = m.b.shape;
    Manifold all[kPatchesOfPair];
    Manifold some[kPatchesOfPair];
    const int count = make_manifolds(a, m.path_a.start, b, m.path_b.start, m.reach_m, all);
    const int told = make_manifolds<OneLaneOfHulls>(a, m.path_a.start, b, m.path_b.start, m.reach_m, some);
    left += told == kLeft ? 1 : 0;
    if (told == kLeft) continue;
    ASSERT_EQ(told, count) << trial;
    made += count;
    if (count > 0) {
      EXPECT_TRUE(is_same(all[0], some[0])) << trial;
    }
  }
  EXPECT_GT(made, 100);
  EXPECT_LT(left, 30);
}

TEST(QuickHulls, TellWhatPatchesTell) {
  Draw draw(3);
  const auto body = [&draw](int) { return boulder(draw, 60); };
  const QuickCounts counts = compare_quick_answers(
      draw, 300, body, body,
      [](const Subject& a, const ContactPose& at_a, const Subject& b, const ContactPose& at_b, float seen_m) {
        EXPECT_TRUE(has_quick_answers(a.shape, b.shape));
        return hull_bounds(a.shape, at_a, b.shape, at_b, seen_m);
      });
  expect_most_are_quick(counts);
}

}  // namespace
}  // namespace broadside::core
