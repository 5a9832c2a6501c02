// How fast bodies move at the beginning of a step.
#include "core/scene/pace.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace broadside::core {
namespace {

constexpr Vec3 kDown{0, -10, 0};
constexpr float kStep_s = 0.01F;  // gravity gives 0.2 m/s in two steps

// One body with a reach of half a meter, whose angular velocity equals its angular momentum, beside a static one.
bool is_calm_at(Vec3 v, Vec3 angular_momentum, Vec3 gravity_m_s2 = kDown) {
  RigidBodies bodies;
  bodies.mass.resize(2);
  bodies.mass[0].inverse_mass = 1.0F;
  bodies.mass[0].inverse_inertia = {1, 1, 1, 0, 0, 0};
  bodies.shapes.resize(1);
  bodies.shapes[0].balls = {0.5F, 0.25F};
  bodies.shape = {0, 0};
  std::vector<RigidState> states(2);
  states[0].v = v;
  states[0].angular_momentum = angular_momentum;
  states[1].v = {100, 0, 0};
  return is_calm(pace_of(bodies, states, kStep_s), gravity_m_s2, kStep_s);
}

TEST(Pace, IsCalmWhereGravityMakesTheFastestPointAsFastInTwoSteps) {
  EXPECT_TRUE(is_calm_at({}, {}));
  EXPECT_TRUE(is_calm_at({0.19F, 0, 0}, {}));
  EXPECT_FALSE(is_calm_at({0.21F, 0, 0}, {}));
  EXPECT_TRUE(is_calm_at({}, {0, 0.38F, 0}));
  EXPECT_FALSE(is_calm_at({}, {0, 0.42F, 0}));
  EXPECT_FALSE(is_calm_at({0.11F, 0, 0}, {0, 0, 0.2F}));
}

// Without gravity there is no measure of slow, but a scene in which everything stands still is calm.
TEST(Pace, WithoutGravityIsCalmWhereAllStandsStill) {
  EXPECT_TRUE(is_calm_at({}, {}, {}));
  EXPECT_FALSE(is_calm_at({0.001F, 0, 0}, {}, {}));
}

// The stride is counted in half thicknesses of the thinner of two bodies, also where the thicker one is faster.
TEST(Pace, AStrideIsCountedInHalfThicknesses) {
  RigidBodies bodies;
  bodies.mass.resize(3);
  bodies.mass[0].inverse_mass = bodies.mass[1].inverse_mass = 1.0F;
  bodies.shapes.resize(2);
  bodies.shapes[0].half_thickness_m = 0.02F;
  bodies.shapes[1].half_thickness_m = 0.5F;
  bodies.shape = {0, 1, 0};
  std::vector<RigidState> states(3);
  states[0].v = {0, -3, 0};
  states[1].v = {0, -5, 0};
  states[2].v = {100, 0, 0};
  const Pace pace = pace_of(bodies, states, kStep_s);
  EXPECT_EQ(pace.fastest_m_s, 5.0F);
  EXPECT_NEAR(pace.stride, 1.5F, 1e-6F);
  states[1].v.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(pace_of(bodies, states, kStep_s).stride, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(is_calm(pace_of(bodies, states, kStep_s), kDown, kStep_s));
}

}  // namespace
}  // namespace broadside::core
