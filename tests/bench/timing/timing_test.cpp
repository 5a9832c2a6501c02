// How an engine that runs ahead is timed: in one call, in which a frame's time is the interval between two completions.
#include "bench/timing/timing.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "core/engine/runs_ahead.hpp"
#include "core/trace/trace_writer.hpp"
#include "datasets/scenes.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

// The engines below record here what they did, because a row's create() is a plain function.
struct Told {
  std::uint64_t steps = 0;
  std::vector<std::uint64_t> runs;  // how many steps each was asked for
  double in_runs_s = 0.0;           // of the last run: from its call to its last completion
};
Told told;

// Steps begin two at a time and are reported one by one.
class Ahead final : public core::Dynamics, public core::RunsAhead {
 public:
  core::Status load(const core::Scene& /*scene*/) override { return core::Done{}; }
  core::Status step(float /*dt_s*/) override {
    ++told.steps;
    ++done_;
    return core::Done{};
  }
  core::Status run(float /*dt_s*/, std::uint64_t steps, const StepDone& step_done) override {
    const auto start = Clock::now();
    told.runs.push_back(steps);
    for (std::uint64_t k = 0; k < steps; ++k) {
      if (k % 2 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
      ++done_;
      told.in_runs_s = seconds_between(start, Clock::now());
      if (!step_done()) break;
    }
    return core::Done{};
  }
  core::Status read_back(core::FrameRecord& frame, core::RecordLevel /*level*/) override {
    frame.step = done_;
    frame.digest = 1000 + done_;
    return core::Done{};
  }
  [[nodiscard]] std::uint32_t groups() const override { return 0; }
  [[nodiscard]] std::span<const core::StageTime> stage_times() const override {
    stage_ = {"turning", static_cast<double>(done_)};
    return {&stage_, 1};
  }

 private:
  std::uint64_t done_ = 0;
  mutable core::StageTime stage_;
};

core::Result<core::Engine> create(const core::Settings& settings) {
  core::Engine engine;
  engine.id = "ahead";
  engine.build = "test";
  engine.settings = settings;
  engine.dynamics = std::make_unique<Ahead>();
  return engine;
}

const core::EngineRow kRow{.id = "ahead",
                           .capabilities = "dynamics",
                           .what = "runs ahead",
                           .settings = {},
                           .runs_in_child = false,
                           .create = create,
                           .absent = [] { return std::string(); }};

RunPlan plan_of(std::uint64_t frames) {
  RunPlan plan;
  plan.scene.name = "nothing";
  plan.frames = frames;
  plan.cells = {{&kRow, {}}};
  return plan;
}

const std::vector<double>& series(const core::Sample& sample, std::string_view stage) {
  static const std::vector<double> kNone;
  for (const core::StageSeries& s : sample.stages)
    if (s.stage == stage) return s.seconds;
  return kNone;
}

TEST(Timing, OfAnEngineThatRunsAheadIsFromOneEndToTheNext) {
  told = {};
  const RunPlan plan = plan_of(7);
  const auto start = Clock::now();
  auto sample = time_run(plan, plan.cells[0], 5);
  const double all_s = seconds_between(start, Clock::now());
  ASSERT_TRUE(sample.ok()) << sample.error().line();
  EXPECT_EQ(told.steps, 0U);
  EXPECT_EQ(told.runs, std::vector<std::uint64_t>{5});
  EXPECT_EQ(sample.value().final_step, 5U);
  EXPECT_EQ(sample.value().final_digest, 1005U);
  EXPECT_EQ(series(sample.value(), "turning"), (std::vector<double>{1, 2, 3, 4, 5})) << "each step's own";
  const std::vector<double>& frames = series(sample.value(), "frame");
  ASSERT_EQ(frames.size(), 5U);
  const double sum_s = std::accumulate(frames.begin(), frames.end(), 0.0);
  EXPECT_GE(sum_s, told.in_runs_s) << "nothing between the call and the last end is left out";
  EXPECT_LE(sum_s, all_s);
}

TEST(Timing, NobodyRunsAheadInTurns) {
  told = {};
  int ends[2] = {-1, -1};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  constexpr std::uint64_t kFrames = 30;
  std::thread other([&ends] {
    Turns turns;
    ASSERT_TRUE(turns.join("second:" + std::to_string(ends[1]) + ":-1").ok());
    turns.begin();
    for (std::uint64_t k = 0; k < kWarmUpFrames + kFrames; ++k) turns.frame_done();
    turns.end();
  });
  Turns turns;
  ASSERT_TRUE(turns.join("first:" + std::to_string(ends[0]) + ":-1").ok());
  EXPECT_FALSE(turns.are_alone());
  auto samples = time_plan(plan_of(kFrames), 1, turns);
  other.join();
  ASSERT_TRUE(samples.ok()) << samples.error().line();
  EXPECT_EQ(told.steps, kWarmUpFrames + kFrames);
  EXPECT_TRUE(told.runs.empty());
  EXPECT_EQ(series(samples.value()[0], "frame").size(), kFrames);
}

// An engine that reports a second for its own filter.
class Filtering final : public core::BroadPhase {
 public:
  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }
  core::Status load(std::span<const core::Box>, std::span<const std::uint8_t>) override { return core::Done{}; }
  core::Status update(std::span<const core::Box>) override { return core::Done{}; }
  core::Status find() override { return core::Done{}; }
  core::Result<core::PairSet> read_back() override { return core::PairSet{{{0, 1}}, 1, 1, 1.0}; }
};

TEST(Timing, AFrameOfABroadPhaseContainsItsFilter) {
  const core::EngineRow row{.id = "filtering",
                            .capabilities = "broad",
                            .what = "filters for a second",
                            .settings = {},
                            .runs_in_child = false,
                            .create = [](const core::Settings& settings) -> core::Result<core::Engine> {
                              core::Engine engine;
                              engine.id = "filtering";
                              engine.settings = settings;
                              engine.broad_phase = std::make_unique<Filtering>();
                              return engine;
                            },
                            .absent = [] { return std::string(); }};
  auto scene = datasets::make_scene("two-body:apart");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  RunPlan plan;
  plan.scene = std::move(scene).value();
  plan.frames = 3;
  plan.cells = {{&row, {}}};
  plan.folder = std::filesystem::path(testing::TempDir()) / "timing_of_a_filter";
  std::filesystem::remove_all(plan.folder);
  std::filesystem::create_directories(plan.folder);
  core::TraceHeader header;
  header.scene = plan.scene;
  header.stamp = {
      .scene_name = plan.scene.name, .scene_digest = core::scene_digest(plan.scene), .engine = "octree-cpu"};
  header.groups = core::bit(core::Group::kDetection);
  auto writer = core::TraceWriter::create(plan.folder / "octree-cpu.h5", header);
  ASSERT_TRUE(writer.ok()) << writer.error().line();
  for (std::uint64_t step = 1; step <= plan.frames; ++step) {
    core::FrameRecord frame;
    frame.step = step;
    frame.detected_position.resize(plan.scene.bodies.size());
    frame.detected_velocity.resize(plan.scene.bodies.size());
    frame.boxes.resize(plan.scene.bodies.size());
    ASSERT_TRUE(writer.value().append(frame).ok());
  }
  ASSERT_TRUE(writer.value().finish().ok());
  auto sample = time_run(plan, plan.cells[0], plan.frames);
  ASSERT_TRUE(sample.ok()) << sample.error().line();
  EXPECT_EQ(series(sample.value(), "filter"), (std::vector<double>{1, 1, 1}));
  for (std::size_t k = 0; k < plan.frames; ++k)
    EXPECT_NEAR(series(sample.value(), "frame")[k],
                series(sample.value(), "update")[k] + series(sample.value(), "find")[k] + 1.0, 1e-9);
  std::filesystem::remove_all(plan.folder);
}

}  // namespace
}  // namespace broadside::bench
