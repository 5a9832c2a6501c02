// Energy over time from a trace alone, against closed forms: free flight keeps it, a wrench adds its work.
#include "bench/contest/energy_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/contest/contest_table.hpp"
#include "core/trace/trace_writer.hpp"
#include "datasets/scenes.hpp"
#include "reference/plain_rigid/engine.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using bench::contest::EnergyCurve;

// A trace of plain-rigid on this scene; with changed states where the test says so.
template <typename Change>
void record_changed(const core::Scene& scene, const std::filesystem::path& file, const Change& change) {
  reference::plain::PlainWorld engine({});
  EXPECT_TRUE(engine.load(scene).ok());
  core::TraceHeader header;
  header.scene = scene;
  header.stamp.scene_digest = core::scene_digest(scene);
  header.groups = core::bit(core::Group::kBodies) | core::bit(core::Group::kWideBodies);
  auto writer = core::TraceWriter::create(file, header);
  EXPECT_TRUE(writer.ok());
  for (std::uint32_t k = 0; k < scene.frames; ++k) {
    core::FrameRecord frame;
    EXPECT_TRUE(engine.step(scene.dt_s).ok());
    EXPECT_TRUE(engine.read_back(frame, core::RecordLevel::kFull).ok());
    change(frame);
    EXPECT_TRUE(writer.value().append(frame).ok());
  }
  EXPECT_TRUE(writer.value().finish().ok());
}

template <typename Change>
EnergyCurve curve_of(const core::Scene& scene, std::size_t most_frames, const Change& change) {
  const Folder folder;
  record_changed(scene, folder / "t.h5", change);
  auto curve = bench::contest::energy_curve(folder / "t.h5", most_frames);
  EXPECT_TRUE(curve.ok()) << curve.error().line();
  return curve.ok() ? curve.value() : EnergyCurve{};
}

constexpr auto kAsItIs = [](core::FrameRecord&) {};

// A brick that turns freely: kinetic energy alone, 1/2 w I w of 10 kg of 0.1 x 0.4 x 0.9 m at (0.1, 5, 0.1) rad/s.
TEST(EnergyCurve, AFreeBrickKeepsItsEnergy) {
  const core::Scene scene = datasets::make_scene("rigid:torque-free:box[frames=200]").value();
  const EnergyCurve curve = curve_of(scene, 50, kAsItIs);
  ASSERT_GE(curve.time_s.size(), 50U);
  EXPECT_LE(curve.time_s.size(), 52U);
  EXPECT_EQ(curve.time_s.front(), 0.0);
  EXPECT_NEAR(curve.time_s.back(), 200.0 * scene.dt_s, 1e-9);
  for (const double gained : curve.gained_j) EXPECT_NEAR(gained, 0.0, 1e-6);
}

TEST(EnergyCurve, ASpinThatStopsLosesWhatItHad) {
  const core::Scene scene = datasets::make_scene("rigid:torque-free:box[frames=2]").value();
  const EnergyCurve curve = curve_of(scene, 10, [](core::FrameRecord& f) {
    f.angular_velocity[0] = {};
    f.wide.angular_velocity[0] = {};
  });
  const double x = 10.0 / 12 * (0.16 + 0.81);
  const double y = 10.0 / 12 * (0.01 + 0.81);
  const double z = 10.0 / 12 * (0.01 + 0.16);
  EXPECT_NEAR(curve.gained_j.back(), -0.5 * (0.01 * x + 25.0 * y + 0.01 * z), 1e-5);
}

// A torque T about a principal axis adds T times the angle w0 t + T t^2 / (2 I).
TEST(EnergyCurve, AWrenchAddsItsWork) {
  const core::Scene scene = datasets::make_scene("rigid:spin-up[frames=240]").value();
  const EnergyCurve curve = curve_of(scene, 10, kAsItIs);
  EXPECT_GT(curve.gained_j.back(), 0.1);
  EXPECT_TRUE(std::is_sorted(curve.gained_j.begin(), curve.gained_j.end()));
}

// Cells may be kept without their traces, which are large.
TEST(EnergyCurve, IsKeptWhereTheTraceIsNot) {
  const Folder folder;
  record_changed(datasets::make_scene("rigid:spin-up[frames=240]").value(), folder / "t.h5", kAsItIs);
  bench::contest::ContestTable table;
  table.entrants = {{"mine", ""}};
  table.scenes = {{.scene = "rigid:spin-up"}};
  table.scenes[0].entries["mine"][""].trace_file = "t.h5";
  ASSERT_TRUE(bench::contest::read_energy(table, folder / "", {"rigid:spin-up"}));
  const EnergyCurve read = table.scenes[0].energy.at("mine");
  ASSERT_GT(read.time_s.size(), 100U);
  std::filesystem::remove(folder / "t.h5");
  for (int times = 0; times < 2; ++times) {  // the curve that was kept is kept again
    table.scenes[0].energy.clear();
    ASSERT_TRUE(bench::contest::read_energy(table, folder / "", {"rigid:spin-up"}));
    ASSERT_EQ(table.scenes[0].energy.count("mine"), 1U);
    EXPECT_EQ(table.scenes[0].energy.at("mine").time_s, read.time_s);
    EXPECT_EQ(table.scenes[0].energy.at("mine").gained_j, read.gained_j);
  }
  std::filesystem::remove(folder / "energy.json");
  table.scenes[0].energy.clear();
  ASSERT_TRUE(bench::contest::read_energy(table, folder / "", {"rigid:spin-up"}));
  EXPECT_TRUE(table.scenes[0].energy.empty());
}

TEST(EnergyCurve, WhatIsNoTraceIsAnError) {
  EXPECT_FALSE(bench::contest::energy_curve("/nowhere/t.h5", 10));
}

}  // namespace
}  // namespace broadside::tests
