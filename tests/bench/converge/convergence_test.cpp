// The order of convergence that errors show, and the verdict where a declared order is not met.
#include "bench/converge/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trace/trace_writer.hpp"
#include "datasets/scenes.hpp"
#include "reference/plain_rigid/engine.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using bench::Convergence;
using bench::FigureErrors;
using core::Outcome;

FigureErrors falling(double order, double floor = 0.0) {
  FigureErrors f;
  f.what = "attitude";
  f.unit = "rad";
  for (int k = 0; k < 3; ++k) f.error.push_back(std::pow(2.0, -order * k));
  f.limit = {1, 1, 1};
  f.floor = floor;
  return f;
}

Outcome judged(double declared, FigureErrors figure) {
  return bench::judge_convergence({declared, {1, 0.5, 0.25}, {std::move(figure)}}).outcome;
}

// Half an order below the declared one is the border to the next lower order.
TEST(Convergence, AnOrderIsHeldAgainstTheDeclaredOne) {
  EXPECT_EQ(judged(2.0, falling(2.0)), Outcome::kPass);
  EXPECT_EQ(judged(2.0, falling(1.51)), Outcome::kPass);
  EXPECT_EQ(judged(2.0, falling(1.49)), Outcome::kFail);
  EXPECT_EQ(judged(1.0, falling(4.0)), Outcome::kPass);
  EXPECT_EQ(judged(1.0, falling(0.0)), Outcome::kFail);
}

TEST(Convergence, WhatIsAtItsFloorOrHasNoOrderIsNotHeldAgainstOne) {
  EXPECT_EQ(judged(4.0, falling(0.0, 2.0)), Outcome::kPass);
  FigureErrors first = falling(1.0);
  first.is_first_order = true;
  EXPECT_EQ(judged(4.0, first), Outcome::kPass);
  FigureErrors none = falling(0.0);
  none.has_order = false;
  none.share = 0.9;
  EXPECT_EQ(judged(4.0, none), Outcome::kPass);
  none.share = 1.1;
  EXPECT_EQ(judged(4.0, none), Outcome::kFail);
  EXPECT_EQ(bench::judge_convergence({1.0, {1, 0.5, 0.25}, {}}).outcome, Outcome::kInconclusive);
}

// Traces of plain-rigid at h, h/2 and h/4 with this declared order.
Convergence measured(const std::string& name, const std::string& order) {
  const Folder folder;
  std::vector<std::filesystem::path> traces;
  for (int part = 0; part < 3; ++part) {
    core::Scene scene = datasets::make_scene(name).value();
    scene.dt_s = std::ldexp(scene.dt_s, -part);
    scene.frames <<= static_cast<unsigned>(part);
    reference::plain::PlainWorld engine({});
    EXPECT_TRUE(engine.load(scene).ok());
    core::TraceHeader header;
    header.scene = scene;
    header.stamp.scene_digest = core::scene_digest(scene);
    header.groups = core::bit(core::Group::kBodies) | core::bit(core::Group::kWideBodies);
    header.declaration = core::Declaration::of({{"motion", "rigid"}, {"order", order}, {"precision", "f64"}});
    traces.push_back(folder / ("t" + std::to_string(part) + ".h5"));
    auto writer = core::TraceWriter::create(traces.back(), header);
    EXPECT_TRUE(writer.ok()) << writer.error().line();
    for (std::uint32_t k = 0; k < scene.frames; ++k) {
      core::FrameRecord frame;
      EXPECT_TRUE(engine.step(scene.dt_s).ok());
      EXPECT_TRUE(engine.read_back(frame, core::RecordLevel::kFull).ok());
      EXPECT_TRUE(writer.value().append(frame).ok());
    }
    EXPECT_TRUE(writer.value().finish().ok());
  }
  auto convergence = bench::measure_convergence(traces);
  EXPECT_TRUE(convergence.ok()) << convergence.error().line();
  return convergence.ok() ? convergence.value() : Convergence{};
}

// A torque is applied once a step, so the angle converges with order one: where the fourth order is declared, the law
// fails.
TEST(Convergence, AWrongDeclarationFails) {
  const auto right = bench::judge_convergence(measured("rigid:spin-up", "1"));
  EXPECT_EQ(right.outcome, Outcome::kPass) << right.explanation;
  EXPECT_NEAR(right.measured, 1.0, 0.1);
  const auto wrong = bench::judge_convergence(measured("rigid:spin-up", "4"));
  EXPECT_EQ(wrong.outcome, Outcome::kFail) << wrong.explanation;
  EXPECT_NE(wrong.explanation.find("attitude falls with order 1"), std::string::npos) << wrong.explanation;
}

// Its orientations come from a method of the fourth order; because the angular momentum is constant, the order is even
// higher.
TEST(Convergence, FreeTurningOfPlainRigidIsOfTheFourthOrderAtLeast) {
  const Convergence c = measured("rigid:torque-free:box[dt_s=0.02,frames=150]", "4");
  const auto verdict = bench::judge_convergence(c);
  EXPECT_EQ(verdict.outcome, Outcome::kPass) << verdict.explanation;
  ASSERT_FALSE(c.figures.empty());
  EXPECT_EQ(c.figures[0].what, "attitude");
  EXPECT_GT(bench::observed_order(c.figures[0], 2), 3.7);
}

}  // namespace
}  // namespace broadside::tests
