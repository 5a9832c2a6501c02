// The two-body scenes against closed forms, worked out here by hand from the laws of METHOD 1 and 4 to 6 and the
// scenes' numbers: cubes of 1 m and 1 kg, restitution 0.3, frictions 0.6 and 0.5, slop 1 mm, steps of 1/60 s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "datasets/scenes.hpp"
#include "tests/datasets/twin_run.hpp"

namespace broadside {
namespace {

const double kStep = 1.0F / 60.0F;
const double kGravity = 9.81F;
constexpr double kSlop = 0.001;
// Positions up to 4 m are rounded to 2^-22 at worst once per operation; 120 steps of a few operations each.
constexpr double kRounding = 500.0 * 0x1p-22;

core::Scene scene_of(const std::string& name) {
  auto scene = datasets::make_scene("two-body:" + name);
  EXPECT_TRUE(scene.ok()) << scene.error().line();
  return scene.ok() ? std::move(scene).value() : core::Scene{};
}

void expect_near(core::Vec3 measured, double x, double y, double z, const std::string& what) {
  EXPECT_NEAR(measured.x, x, kRounding) << what;
  EXPECT_NEAR(measured.y, y, kRounding) << what;
  EXPECT_NEAR(measured.z, z, kRounding) << what;
}

// Approach at 2 m/s, equal masses: J = (1 + e) 2 / 2 = 1.3 N s, so each leaves at 0.3 m/s.
TEST(TwoBody, HeadOnLeavesAtTheRestitution) {
  const auto frames = tests::run_twin(scene_of("head-on")).frames;
  // Centers start 2 m apart and faces meet after 0.5 s: in step 30 by rounding, or in step 31.
  std::size_t first = 0;
  while (first < frames.size() && frames[first].contacts.empty()) ++first;
  ASSERT_LT(first, frames.size());
  EXPECT_GE(frames[first].step, 30U);
  EXPECT_LE(frames[first].step, 31U);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const bool is_after = k >= first;
    expect_near(frames[k].velocity[0], is_after ? -0.3 : 1.0, 0.0, 0.0, std::to_string(k));
    expect_near(frames[k].velocity[1], is_after ? 0.3 : -1.0, 0.0, 0.0, std::to_string(k));
    EXPECT_NEAR(frames[k].position[0].x + frames[k].position[1].x, 0.0F, kRounding);
  }
  // Corrected down to the slop, if they were deeper.
  const double depth = 2.0 * static_cast<double>(frames[first].step) * kStep - 1.0;
  const double gap = frames[first].position[1].x - frames[first].position[0].x;
  EXPECT_NEAR(gap, 1.0 - std::min(depth, kSlop), kRounding);
  const double later = frames[first + 40].position[1].x - frames[first + 40].position[0].x;
  EXPECT_NEAR(later, gap + 40.0 * kStep * 0.6, kRounding);
}

// 4 kg at 1 m/s against 1 kg at -1 m/s: the reduced mass is 0.8 kg, J = 1.3 * 2 * 0.8 = 2.08 N s.
TEST(TwoBody, UnequalMassesShareTheImpulse) {
  const auto last = tests::run_twin(scene_of("unequal")).frames[60];
  expect_near(last.velocity[0], 1.0 - 2.08 / 4.0, 0.0, 0.0, "4 kg");
  expect_near(last.velocity[1], -1.0 + 2.08, 0.0, 0.0, "1 kg");
}

// Sliding at 0.5 m/s needs J_t = 0.25 N s, within 0.6 * 1.3: it sticks, and both move on at the mean of 0.25 m/s.
TEST(TwoBody, GlancingSticks) {
  const auto last = tests::run_twin(scene_of("glancing")).frames[60];
  expect_near(last.velocity[0], -0.3, 0.25, 0.0, "first");
  expect_near(last.velocity[1], 0.3, 0.25, 0.0, "second");
}

// Sliding at 4 m/s would need 2 N s, more than 0.6 * 1.3: it slides on, braked by 0.5 * 1.3 = 0.65 N s.
TEST(TwoBody, ObliqueSlides) {
  const auto last = tests::run_twin(scene_of("oblique")).frames[45];
  expect_near(last.velocity[0], -0.3, 4.0 - 0.65, 0.0, "first");
  expect_near(last.velocity[1], 0.3, 0.65, 0.0, "second");
}

// Each step gravity gives v_y = -g dt, which the floor takes back with J_n = g dt; friction takes 0.5 g dt from the
// sliding while it is above 0.6 g dt, and all of it then. So n = ceil((v0 - 0.6 g dt) / (0.5 g dt)) steps slide, the
// next one sticks, and step k moved by dt times the speed that step k - 1 left.
TEST(TwoBody, SlideStopsWhereFrictionSays) {
  const auto frames = tests::run_twin(scene_of("slide")).frames;
  const double loss = 0.5 * kGravity * kStep;
  const double n = std::ceil((3.0 - 0.6 * kGravity * kStep) / loss);
  ASSERT_EQ(n, 36.0);
  for (std::size_t k = 0; k < 36; ++k)
    expect_near(frames[k].velocity[0], 3.0 - loss * static_cast<double>(k + 1), 0.0, 0.0, std::to_string(k));
  const double way = kStep * ((n + 1.0) * 3.0 - loss * n * (n + 1.0) / 2.0);
  for (std::size_t k = 36; k < frames.size(); ++k) {
    expect_near(frames[k].velocity[0], 0.0, 0.0, 0.0, std::to_string(k));
    expect_near(frames[k].position[0], -2.0 + way, 0.5 - kSlop, 0.0, std::to_string(k));
  }
}

// A step's fall of g dt^2 = 2.7 mm is corrected down to the slop, and the speed is taken: from the first step on, the
// cube lies one slop deep.
TEST(TwoBody, RestLiesOneSlopDeep) {
  for (const core::FrameRecord& frame : tests::run_twin(scene_of("rest")).frames) {
    expect_near(frame.position[0], 0.0, 0.5 - kSlop, 0.0, std::to_string(frame.step));
    expect_near(frame.velocity[0], 0.0, 0.0, 0.0, std::to_string(frame.step));
  }
}

// The laws for two bodies one above the other, in one dimension and in double: fall, then the contact of the two, then
// the floor, each once a step.
struct Column {
  double low = 0.5, high = 1.5;  // centers
  double v_low = 0.0, v_high = 0.0;
  double w_low = 1.0, w_high = 0.001;  // inverse masses

  static double bounce(double approach) { return approach < 0.3 ? 0.0 : 0.3; }

  void step() {
    v_low -= kGravity * kStep, v_high -= kGravity * kStep;
    low += v_low * kStep, high += v_high * kStep;
    const double depth = low + 1.0 - high;
    if (depth > 0.0) {
      const double share = std::max(depth - kSlop, 0.0) / (w_low + w_high);
      low -= w_low * share, high += w_high * share;
      const double approach = v_low - v_high;
      if (approach > 0.0) {
        const double impulse = (1.0 + bounce(approach)) * approach / (w_low + w_high);
        v_low -= w_low * impulse, v_high += w_high * impulse;
      }
    }
    const double into_floor = 0.5 - low;
    if (into_floor <= 0.0) return;
    low += std::max(into_floor - kSlop, 0.0);
    if (v_low < 0.0) v_low *= -bounce(-v_low);
  }
};

// 1000 kg on 1 kg: the light cube can take from the heavy one what stops 1 kg and no more, so the heavy one sinks
// through it at nearly free fall. That is the limit of applying each contact once a step, not a fault of one contact.
TEST(TwoBody, AHeavyCubeSinksIntoALightOne) {
  const auto frames = tests::run_twin(scene_of("stack")).frames;
  Column column;
  for (std::size_t k = 0; k < 12; ++k) {
    column.step();
    expect_near(frames[k].position[0], 0.0, column.low, 0.0, "low, frame " + std::to_string(k));
    expect_near(frames[k].position[1], 0.0, column.high, 0.0, "high, frame " + std::to_string(k));
    EXPECT_NEAR(frames[k].velocity[0].y, column.v_low, 60.0 * kRounding) << k;
    EXPECT_NEAR(frames[k].velocity[1].y, column.v_high, 60.0 * kRounding) << k;
  }
  EXPECT_LT(frames[11].position[1].y, 1.5F - 0.1F);
}

// The other way round it lies still: a light cube on a heavy one takes nothing from it.
TEST(TwoBody, ALightCubeLiesOnAHeavyOne) {
  core::Scene scene = scene_of("stack");
  scene.bodies[0].inverse_mass = 0.001F;
  scene.bodies[1].inverse_mass = 1.0F;
  const auto frames = tests::run_twin(scene).frames;
  // The floor's correction lifts the lower one by up to a step's fall after the two were corrected, and each contact
  // keeps its slop.
  const double fall = kGravity * kStep * kStep;
  for (std::size_t k = 5; k < frames.size(); ++k) {
    EXPECT_NEAR(frames[k].position[0].y, 0.5 - kSlop, kRounding) << k;
    EXPECT_NEAR(frames[k].position[1].y, 1.5 - 2.0 * kSlop, 2.0 * fall + kRounding) << k;
    EXPECT_NEAR(frames[k].velocity[1].y, 0.0, 2.0 * kGravity * kStep) << k;
  }
}

}  // namespace
}  // namespace broadside
