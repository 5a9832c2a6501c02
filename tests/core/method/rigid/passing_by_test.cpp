// A cube that falls past the corner of another one, 2.8 cm beside it.
#include "core/method/rigid/passing_by.hpp"

#include <gtest/gtest.h>

namespace broadside::core {
namespace {

constexpr float kReach_m = 0.2F;
constexpr float kFalls_m = 0.005F;

struct Passing {
  ContactShape cube;
  ContactPath falls;
  ContactPath stands;
  Manifold found;

  // The lower edge of the falling cube starts start_m above the upper edge of the other cube, and ends end_m below it.
  Passing(float beside_m, float start_m, float end_m) {
    cube.kind = ContactKind::kBox;
    cube.half = {0.5F, 0.5F, 0.5F};
    cube.size_m = length(cube.half);
    falls.start.x = {-1.0F - beside_m, 1.0F + start_m, 0.0F};
    falls.end.x = {-1.0F - beside_m, 1.0F - end_m, 0.0F};
    Manifold of_pair[kPatchesOfPair];
    EXPECT_EQ(make_manifolds(cube, falls.start, cube, stands.start, kReach_m, of_pair), 1);
    found = of_pair[0];
  }
  [[nodiscard]] Manifold let(float falls_m) const {
    Manifold kept = found;
    let_pass(kept, cube, falls, cube, stands, kReach_m, falls_m);
    return kept;
  }
};

TEST(PassingBy, TheCornerIsNearest) {
  const Passing p(0.028F, 0.02F, 0.048F);
  EXPECT_LT(p.found.normal.x, -0.8F);
  EXPECT_GT(p.found.normal.y, 0.5F);
}

// Free motion is along the plane between the two side faces, and does not close the gap across it.
TEST(PassingBy, APatchThatIsKeptTakesThePlaneOfTheFaces) {
  const Manifold kept = Passing(0.028F, 0.02F, 0.048F).let(kFalls_m);
  EXPECT_NEAR(kept.normal.x, -1.0F, 1e-6F);
  ASSERT_GT(kept.count, 0);
  for (int k = 0; k < kept.count; ++k) {
    EXPECT_NEAR(kept.points[k].gap_m, 0.028F, 1e-5F);
    EXPECT_NE(kept.points[k].feature, 0U);
  }
}

TEST(PassingBy, WhatIsAsNearAsBodiesFallKeepsItsPlane) {
  const Passing p(0.028F, 0.02F, 0.048F);
  EXPECT_EQ(p.let(0.04F).normal, p.found.normal);
}

// The falling cube would land on the other one.
TEST(PassingBy, WhereNoPlaneLiesBetweenThePatchStays) {
  Passing p(-0.2F, 0.02F, 0.048F);
  const Manifold kept = p.let(kFalls_m);
  EXPECT_EQ(kept.normal, p.found.normal);
  EXPECT_EQ(kept.points[0].gap_m, p.found.points[0].gap_m);
}

}  // namespace
}  // namespace broadside::core
