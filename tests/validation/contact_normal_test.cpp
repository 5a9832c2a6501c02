// METHOD 4 on boxes placed by hand: ties, coinciding centers, and the order of application.
#include "tests/validation/sound_world.hpp"

namespace broadside::tests {
namespace {

// Two unit cubes at rest without gravity, at these positions, and one contact between them.
Recording two_cubes(Vec3 a, Vec3 b, Vec3 normal, float depth_m) {
  core::Scene scene = mixed_scene();
  scene.gravity_m_s2 = {};
  scene.bodies = {body_at(a, {}, 1.0F), body_at(b, {}, 1.0F)};
  Recording r;
  r.header.stamp.settings = "solver=colored";
  r.header.declaration = core::method_declaration();
  r.header.groups = core::bit(core::Group::kContacts);
  Contact c;
  c.a = 0;
  c.b = 1;
  c.normal = normal;
  c.depth_m = depth_m;
  c.pre_a.x = a;
  c.pre_b.x = b;
  c.post_a = c.pre_a;
  c.post_b = c.pre_b;
  r.header.scene = std::move(scene);
  r.frames.emplace_back().step = 1;
  r.frames[0].contacts = {c};
  return r;
}

core::Outcome outcome(const Recording& r) {
  return verdict_of("contact-normal", r).outcome;
}

// Dyadic numbers, so every overlap is exact.
constexpr Vec3 kHere{4.0F, 4.0F, 4.0F};

TEST(ContactNormal, TakesTheLeastOverlapTowardA) {
  const Vec3 there{4.25F, 4.75F, 4.5F};  // overlaps 0.75, 0.25, 0.5
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, -1, 0}, 0.25F)), core::Outcome::kPass);
  EXPECT_EQ(outcome(two_cubes(there, kHere, {0, 1, 0}, 0.25F)), core::Outcome::kPass);
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, 1, 0}, 0.25F)), core::Outcome::kFail) << "from A to B";
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, 0, -1}, 0.5F)), core::Outcome::kFail) << "the second least";
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, -1, 0}, 0.5F)), core::Outcome::kFail) << "another axis' depth";
}

TEST(ContactNormal, TiesTakeTheLowestAxis) {
  const Vec3 there{4.0F, 4.5F, 4.5F};  // overlaps 1, 0.5, 0.5
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, -1, 0}, 0.5F)), core::Outcome::kPass);
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, 0, -1}, 0.5F)), core::Outcome::kFail);
}

TEST(ContactNormal, CoincidingCentersTakePlusX) {
  EXPECT_EQ(outcome(two_cubes(kHere, kHere, {1, 0, 0}, 1.0F)), core::Outcome::kPass);
  EXPECT_EQ(outcome(two_cubes(kHere, kHere, {-1, 0, 0}, 1.0F)), core::Outcome::kFail);
  EXPECT_EQ(outcome(two_cubes(kHere, kHere, {0, 1, 0}, 1.0F)), core::Outcome::kFail);
}

TEST(ContactNormal, BoxesThatAreApartMakeNoContact) {
  const Vec3 there{4.0F, 5.5F, 4.0F};
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, -1, 0}, 0.5F)), core::Outcome::kFail);
}

TEST(ContactNormal, OneAxisLeastByMoreThanRoundingDecides) {
  // Overlaps 0.25 + 2^-20 and 0.25: 16 spacings of float apart at this size.
  const Vec3 there{4.75F - 0x1p-20F, 4.75F, 4.0F};
  EXPECT_EQ(outcome(two_cubes(kHere, there, {0, -1, 0}, 0.25F)), core::Outcome::kPass);
  EXPECT_EQ(outcome(two_cubes(kHere, there, {-1, 0, 0}, 0.25F + 0x1p-20F)), core::Outcome::kFail);
}

TEST(ContactNormal, FacesComeAfterPairs) {
  // Cube A reaches 0.25 m through the floor, and overlaps B by 0.25 m on x.
  const Vec3 low{4.0F, 0.25F, 4.0F};
  Recording r = two_cubes(low, {4.75F, 0.5F, 4.0F}, {-1, 0, 0}, 0.25F);
  Contact floor;
  floor.a = 0;
  floor.b = core::kFirstFace + 2;
  floor.color = core::kFaceColor;
  floor.normal = {0, 1, 0};
  floor.depth_m = 0.25F;
  floor.pre_a.x = floor.post_a.x = low;
  r.frames[0].contacts.push_back(floor);
  EXPECT_EQ(outcome(r), core::Outcome::kPass);
  std::swap(r.frames[0].contacts[0], r.frames[0].contacts[1]);
  EXPECT_EQ(outcome(r), core::Outcome::kFail);
}

TEST(ContactNormal, NoContactIsNotApplicable) {
  Recording r = two_cubes(kHere, {7, 7, 7}, {1, 0, 0}, 1.0F);
  r.frames[0].contacts.clear();
  const core::Verdict v = verdict_of("contact-normal", r);
  EXPECT_EQ(v.outcome, core::Outcome::kNotApplicable);
  EXPECT_NE(v.explanation.find("no contacts"), std::string::npos);
}

}  // namespace
}  // namespace broadside::tests
