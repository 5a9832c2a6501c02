// Patches for the end of a step in which bodies turn: a corner that comes down within the step is a contact point from
// the step's start on.
#include "core/method/rigid/end_patches.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

constexpr float kDegree = 0.017453292F;

Quat about_z(float degrees) {
  return {std::cos(0.5F * kDegree * degrees), 0.0F, 0.0F, std::sin(0.5F * kDegree * degrees)};
}

// A cube of a meter that stands on the edge along z at (0, 0), tilted: at 0 degrees it lies on the floor on the side of
// +x, at 90 degrees on the side of -x.
ContactPose on_its_edge(float degrees) {
  const float angle = kDegree * (degrees + 45.0F);
  return {std::sqrt(0.5F) * Vec3{std::cos(angle), std::sin(angle), 0.0F}, about_z(degrees)};
}

struct Turned {
  Manifold patches[kPatchesOfPair];
  int at_start = 0;
  int count = 0;
};

Turned over_the_floor(float from_degrees, float to_degrees, float sunk_m) {
  const Subject cube = box({0.5F, 0.5F, 0.5F});
  const ContactShape floor = domain_face_shape(2);
  const ContactPose floor_pose;
  ContactPath path{on_its_edge(from_degrees), on_its_edge(to_degrees)};
  path.end.x.y -= sunk_m;
  Turned out;
  out.at_start = make_manifolds(cube.shape, path.start, floor, floor_pose, 1.0F, out.patches);
  const float swing_m = std::abs(to_degrees - from_degrees) * kDegree * std::sqrt(0.75F);
  out.count = add_end_patches(cube.shape, path, floor, {floor_pose, floor_pose}, swing_m, out.patches, out.at_start);
  return out;
}

TEST(EndPatches, TakeACornerThatComesDownBackToTheStart) {
  // The edge at (-sin, cos) of the tilt is 0.77 m up at the start and ends 9 cm deep. At the start another face looks
  // down.
  const Turned t = over_the_floor(40.0F, 95.0F, 0.0F);
  ASSERT_EQ(t.at_start, 1);
  ASSERT_EQ(t.count, 2);
  const float up = std::cos(40.0F * kDegree);
  EXPECT_NEAR(t.patches[1].normal.y, 1.0F, 1e-6F);
  EXPECT_EQ(t.patches[1].count, 2);
  for (int k = 0; k < t.patches[1].count; ++k) {
    const ManifoldPoint& p = t.patches[1].points[k];
    EXPECT_NEAR(p.gap_m, up, 1e-5F);
    EXPECT_NEAR(p.point.x + on_its_edge(40.0F).x.x, -std::sin(40.0F * kDegree), 1e-5F);
    EXPECT_NEAR(std::abs(p.point.z), 0.5F, 1e-5F);
  }
}

TEST(EndPatches, LeaveWhatPatchesOfTheStartForeseeToThem) {
  // The edge that the cube stands on sinks in, and a point of the start's patch is there already.
  EXPECT_EQ(over_the_floor(40.0F, 45.0F, 0.05F).count, 1);
  // The cube falls over onto its face, whose corners are in the start's patch.
  EXPECT_EQ(over_the_floor(5.0F, -3.0F, 0.0F).count, 1);
}

TEST(EndPatches, AreNotLookedForWhereNothingTurns) {
  EXPECT_EQ(over_the_floor(40.0F, 40.0F, 0.05F).count, 1);
}

TEST(EndPatches, OfTwoBodiesHaveTheNormalOfTheirEnd) {
  Draw draw(3);
  int found = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Subject a = box({draw.between(0.2F, 0.5F), draw.between(0.2F, 0.5F), draw.between(0.2F, 0.5F)});
    Subject b = box({0.5F, 0.5F, 0.5F});
    const ContactPath way_a{{{0.0F, 1.0F, 0.0F}, draw.turn()}, {{0.0F, 0.9F, 0.0F}, draw.turn()}};
    const ContactPath way_b{{{}, draw.turn()}, {{}, draw.turn()}};
    Manifold patches[kPatchesOfPair];
    const int at_start = make_manifolds(a.shape, way_a.start, b.shape, way_b.start, 2.0F, patches);
    const int count = add_end_patches(a.shape, way_a, b.shape, way_b, 1.0F, patches, at_start);
    ASSERT_LE(count, at_start + 1);
    if (count == at_start) continue;
    ++found;
    a.pose = way_a.end;
    b.pose = way_b.end;
    const exact::SignedDistance end = exact::signed_distance(a.placed(), b.placed());
    EXPECT_LT(end.distance_m, 0.0);
    const Vec3 n = patches[at_start].normal;
    EXPECT_GT(n.x * end.normal.x + n.y * end.normal.y + n.z * end.normal.z, 0.999) << trial;
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace broadside::core
