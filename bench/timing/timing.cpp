#include "bench/timing/timing.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "bench/engines.hpp"
#include "bench/process/child.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/process/progress.hpp"
#include "bench/record/near_pairs.hpp"
#include "bench/timing/turns.hpp"
#include "core/engine/own_step_time.hpp"
#include "core/engine/runs_ahead.hpp"
#include "core/pair.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {
namespace {

using core::Group;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void add_time(core::Sample& sample, std::string_view stage, double seconds) {
  for (core::StageSeries& series : sample.stages) {
    if (series.stage != stage) continue;
    series.seconds.push_back(seconds);
    return;
  }
  sample.stages.push_back({std::string(stage), {seconds}});
}

// Boxes or poses of the driver's frames, for engines that do not simulate. They are in memory before any clock runs.
struct BakedFrames {
  std::vector<std::uint64_t> steps;
  std::vector<core::FrameRecord> frames;
};

core::Result<BakedFrames> bake(const std::filesystem::path& trace, const core::Scene& scene, std::uint32_t groups,
                               std::uint32_t every) {
  auto opened = core::TraceReader::open(trace);
  if (!opened) return opened.error();
  const core::TraceReader& reader = opened.value();
  if (reader.header().stamp.scene_digest != core::scene_digest(scene))
    return core::Error{"the trace is of another scene", trace.string(), "record octree-cpu of this scene first"};
  BakedFrames baked;
  for (std::uint64_t k = 0; k < reader.frame_count(); ++k) {
    if (reader.steps()[k] % every != 0) continue;
    auto frame = reader.read(k, groups);
    if (!frame) return frame.error();
    baked.steps.push_back(reader.steps()[k]);
    baked.frames.push_back(std::move(frame).value());
  }
  return baked;
}

void add_step(core::Sample& sample, const core::Dynamics& dynamics, double whole) {
  for (const core::StageTime& stage : dynamics.stage_times()) add_time(sample, stage.stage, stage.seconds);
  add_time(sample, "frame", whole);
}

// A frame's time runs from the end of one step to the end of the next and includes the work here between them, so that
// the sum of all times is the time of all steps.
core::Status time_ahead(const RunPlan& plan, core::Dynamics& dynamics, core::RunsAhead& ahead, std::uint64_t frames,
                        core::Sample& sample) {
  auto start = Clock::now();
  return ahead.run(plan.scene.dt_s, frames, [&] {
    const auto now = Clock::now();
    add_step(sample, dynamics, std::chrono::duration<double>(now - start).count());
    start = now;
    return !is_interrupted();
  });
}

core::Status time_steps(const RunPlan& plan, core::Dynamics& dynamics, std::uint64_t frames, Turns& turns,
                        core::Sample& sample) {
  // A program behind a pipe may time its steps by a clock of its own.
  const auto* own_clock = dynamic_cast<const core::OwnStepTime*>(&dynamics);
  for (std::uint64_t step = 1; step <= frames && !is_interrupted(); ++step) {
    const auto start = Clock::now();
    if (core::Status s = dynamics.step(plan.scene.dt_s); !s) return s;
    const double whole = seconds_since(start);
    const double own = own_clock != nullptr ? own_clock->last_step_s() : std::numeric_limits<double>::quiet_NaN();
    const bool is_told = own >= 0.0;
    if (is_told) add_time(sample, "pipe", whole - own);
    add_step(sample, dynamics, is_told ? own : whole);
    turns.frame_done();
  }
  return core::Done{};
}

core::Status time_dynamics(const RunPlan& plan, core::Engine& engine, std::uint64_t frames, Turns& turns,
                           core::Sample& sample) {
  core::Dynamics& dynamics = *engine.dynamics;
  if (core::Status s = dynamics.load(plan.scene); !s) return s;
  // A turn may only end when none of this engine's steps is in progress, so engines do not run ahead in turns.
  core::RunsAhead* ahead = turns.are_alone() ? dynamic_cast<core::RunsAhead*>(&dynamics) : nullptr;
  core::Status ran = ahead != nullptr ? time_ahead(plan, dynamics, *ahead, frames, sample)
                                      : time_steps(plan, dynamics, frames, turns, sample);
  if (!ran) return ran;
  core::FrameRecord last;
  if (core::Status s = dynamics.read_back(last, core::RecordLevel::kDigest); !s) return s;
  sample.final_step = last.step;
  sample.final_digest = last.digest;
  return core::Done{};
}

core::Status time_broad(const RunPlan& plan, core::Engine& engine, const BakedFrames& baked, std::uint64_t frames,
                        Turns& turns, core::Sample& sample) {
  std::vector<std::uint8_t> is_static;
  for (const core::Body& body : plan.scene.bodies) is_static.push_back(body.inverse_mass > 0.0F ? 0 : 1);
  core::BroadPhase& broad = *engine.broad_phase;
  core::PairSet found;
  for (std::uint64_t k = 0; k < frames && !is_interrupted(); ++k) {
    if (k == 0) {
      if (core::Status s = broad.load(baked.frames[0].boxes, is_static); !s) return s;
    }
    const auto start = Clock::now();
    if (core::Status s = broad.update(baked.frames[k].boxes); !s) return s;
    const double updated = seconds_since(start);
    if (core::Status s = broad.find(); !s) return s;
    const double both = seconds_since(start);
    auto pairs = broad.read_back();
    if (!pairs) return pairs.error();
    found = std::move(pairs).value();
    add_time(sample, "update", updated);
    add_time(sample, "find", both - updated);
    add_time(sample, "filter", found.filter_s);
    add_time(sample, "frame", both + found.filter_s);
    sample.final_step = baked.steps[k];
    turns.frame_done();
  }
  sample.final_digest = core::pair_digest(found.pairs);
  return core::Done{};
}

core::Status time_narrow(const RunPlan& plan, core::Engine& engine, const BakedFrames& baked, std::uint64_t frames,
                         Turns& turns, core::Sample& sample) {
  core::NarrowPhase& narrow = *engine.narrow_phase;
  if (core::Status s = narrow.load(plan.scene); !s) return s;
  const NearPairs near(plan.scene);
  core::FrameRecord last;
  for (std::uint64_t k = 0; k < frames && !is_interrupted(); ++k) {
    last = baked.frames[k];
    last.measured = near.of(last);
    std::vector<core::Pose> poses;
    for (std::size_t i = 0; i < last.detected_position.size(); ++i)
      poses.push_back({last.detected_position[i], plan.scene.bodies[i].orientation});
    const auto start = Clock::now();
    if (core::Status s = narrow.measure(last.measured, poses); !s) return s;
    const double seconds = seconds_since(start);
    add_time(sample, "measure", seconds);
    add_time(sample, "frame", seconds);
    sample.final_step = baked.steps[k];
    auto separations = narrow.read_back();
    if (!separations) return separations.error();
    last.separations = std::move(separations).value();
    turns.frame_done();
  }
  sample.final_digest = separation_digest(last);
  return core::Done{};
}

// A number that no other process of this machine has on this day.
std::uint64_t process_name() {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return core::splitmix64(static_cast<std::uint64_t>(now) ^ (static_cast<std::uint64_t>(getpid()) << 48U)) | 1U;
}

bool goes_to_a_child(const RunPlan& plan, const CellSpec& spec) {
  return (spec.row->runs_in_child || plan.limits.are_asked) && !plan.times_here;
}

class Timer {
 public:
  Timer(const RunPlan& plan, Turns& turns) : plan_(plan), turns_(turns) {}

  core::Status prepare() {
    const auto needs = [&](auto test) {
      return std::any_of(plan_.cells.begin(), plan_.cells.end(),
                         [&](const CellSpec& c) { return !goes_to_a_child(plan_, c) && test(c); });
    };
    const std::filesystem::path driver = plan_.folder / "octree-cpu.h5";
    if (needs([](const CellSpec& c) { return !offers(*c.row, "dynamics") && offers(*c.row, "broad"); })) {
      auto baked = bake(driver, plan_.scene, bit(Group::kDetection), 1);
      if (!baked) return baked.error();
      boxes_ = std::move(baked).value();
    }
    if (needs([](const CellSpec& c) { return !offers(*c.row, "dynamics") && !offers(*c.row, "broad"); })) {
      auto baked = bake(driver, plan_.scene, bit(Group::kDetection) | bit(Group::kConfirmed), plan_.narrow_every);
      if (!baked) return baked.error();
      poses_ = std::move(baked).value();
    }
    return core::Done{};
  }

  // frames = all: the usual number of frames for the engine's kind.
  core::Result<core::Sample> time(const CellSpec& spec, std::uint64_t most_frames) {
    auto settings = core::Settings::parse(spec.row->id, spec.row->settings, spec.settings);
    if (!settings) return settings.error();
    auto created = spec.row->create(settings.value());
    if (!created) return created.error();
    core::Engine& engine = created.value();
    core::Sample sample;
    sample.stamp = stamp_of(plan_.scene, engine);
    core::Status status = core::Done{};
    if (engine.dynamics)
      status = time_dynamics(plan_, engine, std::min(most_frames, plan_.frames), turns_, sample);
    else if (engine.broad_phase)
      status =
          time_broad(plan_, engine, boxes_, std::min<std::uint64_t>(most_frames, boxes_.frames.size()), turns_, sample);
    else
      status = time_narrow(plan_, engine, poses_, std::min<std::uint64_t>(most_frames, poses_.frames.size()), turns_,
                           sample);
    if (!status) return status.error();
    return sample;
  }

 private:
  const RunPlan& plan_;
  Turns& turns_;
  BakedFrames boxes_;
  BakedFrames poses_;
};

// One repetition in a process of its own, which warms up first.
core::Result<core::Sample> time_in_child(const RunPlan& plan, const CellSpec& spec) {
  CellRequest request;
  request.source = plan.source;
  request.scene = &plan.scene;
  request.row = spec.row;
  request.settings = spec.settings;
  request.frames = plan.frames;
  request.narrow_every = plan.narrow_every;
  request.folder = plan.folder;
  return time_cell_in_child(request, plan.limits);
}

core::Result<core::Sample> time_here(const RunPlan& plan, Timer& timer, const CellSpec& spec, bool is_first) {
  if (is_first) {
    // One frame of a narrow phase is so much work that it is warm-up enough.
    const bool is_narrow = !offers(*spec.row, "dynamics") && !offers(*spec.row, "broad");
    auto warm = timer.time(spec, is_narrow ? 1 : kWarmUpFrames);
    if (!warm) return warm.error();
  }
  return timer.time(spec, plan.frames);
}

}  // namespace

core::Result<core::Sample> time_run(const RunPlan& plan, const CellSpec& spec, std::uint64_t most_frames) {
  RunPlan alone = plan;
  alone.cells = {spec};
  alone.times_here = true;  // in the process of the caller, which decides where it times
  Turns none;
  Timer timer(alone, none);
  if (core::Status s = timer.prepare(); !s) return s.error();
  auto sample = timer.time(spec, most_frames);
  if (!sample) return sample.error();
  if (is_interrupted())
    return core::Error{"interrupted: no time is kept of a run that did not end", "time", "", core::Exit::kMissing};
  return sample;
}

core::Result<std::vector<core::Sample>> time_plan(const RunPlan& plan, std::uint32_t repetitions, Turns& turns) {
  Timer timer(plan, turns);
  if (core::Status s = timer.prepare(); !s) return s.error();
  std::vector<core::Sample> samples;
  const std::uint64_t process = process_name();
  std::vector<bool> has_failed(plan.cells.size());
  Progress progress("timing", std::uint64_t{repetitions} * plan.cells.size());
  turns.begin();
  for (std::uint32_t r = 0; r < repetitions; ++r) {
    for (std::size_t c = 0; c < plan.cells.size(); ++c) {
      const CellSpec& spec = plan.cells[c];
      if (!why_absent(*spec.row).empty() || has_failed[c]) continue;
      const bool is_apart = goes_to_a_child(plan, spec);
      auto sample = is_apart ? time_in_child(plan, spec) : time_here(plan, timer, spec, r == 0);
      if (is_apart) turns.frame_done();
      if (!sample && is_apart && !is_interrupted()) {
        fmt::print(stderr, "broadside: {}\n", sample.error().line());
        has_failed[c] = true;
        continue;
      }
      if (!sample && !is_interrupted()) return sample.error();
      if (is_interrupted())
        return core::Error{"interrupted: no time is kept of a run that did not end", "time", "", core::Exit::kMissing};
      sample.value().repetition = r;
      if (!is_apart) sample.value().process = process;  // a child has set its own
      sample.value().warm_up_frames = kWarmUpFrames;
      samples.push_back(std::move(sample).value());
      progress.at(samples.size());
    }
  }
  turns.end();
  return samples;
}

}  // namespace broadside::bench
