#include "core/method/rigid/patch_twist.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {
namespace {

class RandomPatches {
 public:
  explicit RandomPatches(unsigned seed) : engine_(seed) {}

  float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  Vec3 vector(float size) { return {in(-size, size), in(-size, size), in(-size, size)}; }

  SolverBody body() {
    SolverBody b;
    b.inverse_mass = in(0.1F, 2.0F);
    b.inverse_inertia = {in(1.0F, 3.0F),  in(1.0F, 3.0F),  in(1.0F, 3.0F),
                         in(-0.3F, 0.3F), in(-0.3F, 0.3F), in(-0.3F, 0.3F)};
    b.v = vector(2.0F);
    b.angular_momentum = vector(0.5F);
    return b;
  }
  PatchConstraint patch(const SolverBody& a, const SolverBody& b, float mu, float restitution) {
    Manifold m;
    m.normal = normalized(vector(1.0F) + Vec3{0.0F, 2.0F, 0.0F});
    m.count = std::uniform_int_distribution<int>(1, kManifoldPoints)(engine_);
    for (int k = 0; k < m.count; ++k) m.points[k] = {vector(0.5F), 0.0F, 1};
    return make_constraint(m, a, b, vector(1.0F), {mu, mu, restitution});
  }

 private:
  std::mt19937 engine_;
};

// The velocity of A's point minus that of B's, from the bodies alone, along the normal and the tangents.
Vec3 speed_of_point(const PatchConstraint& c, const PatchPoint& p, const SolverBody& a, const SolverBody& b) {
  const Vec3 of_a = a.v + cross(angular_velocity(a), arm_a<float>(c, p));
  const Vec3 of_b = b.v + cross(angular_velocity(b), arm_b<float>(c, p));
  return in_patch<float>(c, of_a - of_b);
}

TEST(PatchTwist, APointIsAsFastAsItsBodiesMakeIt) {
  RandomPatches random(1);
  for (int n = 0; n < 100; ++n) {
    const SolverBody a = random.body();
    const SolverBody b = n % 4 == 0 ? SolverBody{} : random.body();
    const PatchConstraint c = random.patch(a, b, 0.5F, 0.0F);
    const PatchMotion m = motion_of<float>(c, a, b);
    for (int k = 0; k < c.count; ++k) {
      const Vec3 expected = speed_of_point(c, c.points[k], a, b);
      EXPECT_NEAR(normal_speed(m.twist, c.points[k].lever), expected.x, 2e-5);
      EXPECT_NEAR(tangent_1_speed(m.twist, c.points[k].lever), expected.y, 2e-5);
      EXPECT_NEAR(tangent_2_speed(m.twist, c.points[k].lever), expected.z, 2e-5);
    }
  }
}

// The change of every point's velocity, as the columns give it for an impulse, is the change that the bodies'
// velocities give.
TEST(PatchTwist, AnImpulseChangesPointsAsItChangesTheBodies) {
  RandomPatches random(2);
  for (int n = 0; n < 100; ++n) {
    SolverBody a = random.body();
    SolverBody b = n % 4 == 0 ? SolverBody{} : random.body();
    PatchConstraint c = random.patch(a, b, 0.5F, 0.0F);
    PatchMotion m = motion_of<float>(c, a, b);
    for (int k = 0; k < c.count; ++k) {
      const Vec3 lever = c.points[k].lever;
      const float impulse[3] = {random.in(-1.0F, 1.0F), random.in(-1.0F, 1.0F), random.in(-1.0F, 1.0F)};
      m.twist = plus<float>(m.twist, impulse[0], gain_by_normal(c.mobility, lever));
      m.twist = plus<float>(m.twist, impulse[1], gain_by_tangent_1(c.mobility, lever));
      m.twist = plus<float>(m.twist, impulse[2], gain_by_tangent_2(c.mobility, lever));
      m.given.add_normal(lever, impulse[0]);
      m.given.add_tangents(lever, impulse[1], impulse[2]);
    }
    store<float>(c, m, a, b);
    for (int k = 0; k < c.count; ++k) {
      const Vec3 expected = speed_of_point(c, c.points[k], a, b);
      EXPECT_NEAR(normal_speed(m.twist, c.points[k].lever), expected.x, 1e-4);
      EXPECT_NEAR(tangent_1_speed(m.twist, c.points[k].lever), expected.y, 1e-4);
      EXPECT_NEAR(tangent_2_speed(m.twist, c.points[k].lever), expected.z, 1e-4);
    }
  }
}

// A ball on the ground: the closed form.
TEST(PatchTwist, ABallLeavesWithItsShareOfTheSpeed) {
  SolverBody a;
  a.inverse_mass = 0.5F;
  a.inverse_inertia = {1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  a.v = {0.0F, -3.0F, 0.0F};
  SolverBody ground;
  Manifold m;
  m.normal = {0.0F, 1.0F, 0.0F};
  m.count = 1;
  m.points[0] = {{0.0F, -0.5F, 0.0F}, 0.0F, 1};
  SoftStep step = soft_step(1.0F / 240.0F, 6.0F, 1.0F);
  step.bounce_from_m_s = 0.1F;
  PatchConstraint c = make_constraint(m, a, ground, {}, {0.6F, 0.5F, 0.5F});
  ASSERT_TRUE(note_approach(c, a, ground, step));
  (void)solve_patch<float>(c, goals_of<float>(c, a, ground, step), a, ground, step);
  (void)relax_patch<float>(c, goals_after_motion<float>(c, a, ground, step), a, ground);
  note_budget(c);
  (void)bounce(c, a, ground, 0.0F);
  EXPECT_NEAR(a.v.y, 1.5F, 1e-5F);
}

std::uint32_t bits(float x) {
  return std::bit_cast<std::uint32_t>(x);
}
void expect_same_bits(Vec3 one, Vec3 other) {
  EXPECT_EQ(bits(one.x), bits(other.x));
  EXPECT_EQ(bits(one.y), bits(other.y));
  EXPECT_EQ(bits(one.z), bits(other.z));
}

// A GPU solves four points for every patch: the missing points are zeros, and change no bit.
TEST(PatchTwist, PointsOfZerosChangeNoBit) {
  RandomPatches random(3);
  SoftStep step = soft_step(1.0F / 240.0F, 6.0F, 1.0F);
  step.gravity_m_s2 = 9.81F;
  for (int n = 0; n < 400; ++n) {
    SolverBody a = random.body();
    SolverBody b = n % 4 == 0 ? SolverBody{} : random.body();
    // Bodies at rest, or that move slowly along an axis: zeros of either sign.
    if (n % 3 == 0) a.v = b.v = {0.0F, -0.0F, n % 2 == 0 ? 0.0F : -1e-3F};
    if (n % 3 == 0) a.angular_momentum = b.angular_momentum = {-0.0F, 0.0F, -0.0F};
    PatchConstraint c = random.patch(a, b, 0.5F, 0.0F);
    for (int k = 0; k < c.count; ++k) c.points[k].gap_m = random.in(-0.01F, 0.01F);
    c.slop_m = 1e-3F;
    PatchConstraint four = c;
    four.count = kManifoldPoints;
    SolverBody a_of_four = a;
    SolverBody b_of_four = b;
    for (int sweep = 0; sweep < 3; ++sweep) {
      const float size = solve_patch<float>(c, goals_of<float>(c, a, b, step), a, b, step);
      const PatchGoals goals = goals_of<float>(four, a_of_four, b_of_four, step);
      EXPECT_EQ(bits(size), bits(solve_patch<float>(four, goals, a_of_four, b_of_four, step)));
      const float relaxed = relax_patch<float>(c, goals_after_motion<float>(c, a, b, step), a, b);
      const PatchGoals after = goals_after_motion<float>(four, a_of_four, b_of_four, step);
      EXPECT_EQ(bits(relaxed), bits(relax_patch<float>(four, after, a_of_four, b_of_four)));
    }
    expect_same_bits(a.v, a_of_four.v);
    expect_same_bits(a.angular_momentum, a_of_four.angular_momentum);
    expect_same_bits(b.v, b_of_four.v);
    expect_same_bits(b.angular_momentum, b_of_four.angular_momentum);
    expect_same_bits(whole_push(c).impulse, whole_push(four).impulse);
    expect_same_bits(whole_push(c).moment, whole_push(four).moment);
    for (int k = c.count; k < kManifoldPoints; ++k) {
      const PatchPoint& p = four.points[k];
      EXPECT_EQ(bits(p.normal_impulse) | bits(p.tangent_impulse_1) | bits(p.tangent_impulse_2), 0U);
      EXPECT_FALSE(p.slides);
    }
  }
}

}  // namespace
}  // namespace broadside::core
