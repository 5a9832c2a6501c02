#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/limit_arguments.hpp"
#include "bench/engines.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/record/run_plan.hpp"
#include "bench/timing/interleave.hpp"
#include "bench/timing/timing.hpp"
#include "reports/terminal_times.hpp"
#include "reports/timing.hpp"

namespace broadside::bench {
namespace {

struct TimeArguments {
  SceneArguments scene;
  EngineArguments engines;
  std::uint32_t repetitions = 5;
  std::uint32_t processes = 1;
  std::uint32_t narrow_every = 0;
  std::string out = "out/samples.json";
  std::string in_process;  // the folder for the samples of one cell
  std::string turns;
  ChildLimits limits;
};

// Exit 3 when a cell that was asked for has no sample.
core::Exit exit_of_samples(const RunPlan& plan, const std::vector<core::Sample>& samples) {
  for (const CellSpec& spec : plan.cells)
    if (std::none_of(samples.begin(), samples.end(),
                     [&](const core::Sample& s) { return s.stamp.label() == label_of(spec); }))
      return core::Exit::kMissing;
  return core::Exit::kGood;
}

// The arguments of a child process: all except the number of processes and the file.
std::vector<std::string> own_arguments(const TimeArguments& a) {
  std::vector<std::string> arguments{a.scene.spec, "--repetitions", std::to_string(a.repetitions)};
  for (const std::string& engine : a.engines.engines) arguments.insert(arguments.end(), {"--engine", engine});
  if (!a.engines.file.empty()) arguments.insert(arguments.end(), {"--engines", a.engines.file});
  for (const std::string& setting : a.engines.settings) arguments.insert(arguments.end(), {"--set", setting});
  if (a.scene.frames > 0) arguments.insert(arguments.end(), {"--frames", std::to_string(a.scene.frames)});
  if (a.narrow_every > 0) arguments.insert(arguments.end(), {"--narrow-every", std::to_string(a.narrow_every)});
  if (a.scene.allow_stand_in) arguments.emplace_back("--stand-in");
  if (a.limits.are_asked) arguments.insert(arguments.end(), {"--time-limit", fmt::format("{}", a.limits.seconds)});
  append_memory_limit(arguments, a.limits);
  return arguments;
}

core::Exit time(const TimeArguments& a) {
  if (!a.in_process.empty()) limit_this_process(a.limits.memory_mib);
  Turns turns;
  if (!a.turns.empty())
    if (core::Status s = turns.join(a.turns); !s) return complain(s.error());
  RunPlan plan;
  auto scene = a.scene.make();
  if (!scene) return complain(scene.error());
  plan.source = a.scene;
  plan.scene = std::move(scene).value();
  auto cells = a.engines.make();
  if (!cells) return complain(cells.error());
  plan.cells = std::move(cells).value();
  plan.frames = plan.scene.frames;
  plan.narrow_every = a.narrow_every > 0 ? a.narrow_every : default_narrow_every(plan.frames);
  const std::filesystem::path out = a.out;
  plan.folder = out.has_parent_path() ? out.parent_path() : ".";
  if (core::Status s = prepare_folder(plan.folder); !s) return complain(s.error());

  plan.limits = a.limits;
  plan.times_here = !a.in_process.empty();
  for (const CellSpec& spec : plan.cells) {
    const std::string reason = why_absent(*spec.row);
    if (!reason.empty()) fmt::print("{}: not measured: {}\n", spec.row->id, reason);
  }
  auto samples = a.processes > 1 ? time_in_processes(own_arguments(a), a.processes, plan.folder)
                                 : time_plan(plan, a.repetitions, turns);
  if (!samples) return complain(samples.error());
  if (!a.in_process.empty()) {
    if (core::Status s = core::write_samples(std::filesystem::path(a.in_process) / "samples.json", samples.value()); !s)
      return complain(s.error());
    return exit_of_samples(plan, samples.value());
  }
  // In a folder with recorded cells and verdicts a time is admitted or struck out. In any other folder it is a number
  // without proof.
  auto rows = core::read_rows(plan.folder);
  if (!rows) return complain(rows.error());
  rows.value().samples = samples.value();
  fmt::print("{}", reports::timing_table(reports::pool_samples(rows.value())));
  if (core::Status s = core::write_samples(out, samples.value()); !s) return complain(s.error());
  return exit_of_samples(plan, samples.value());
}

}  // namespace

void add_time(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<TimeArguments>();
  CLI::App* command = program.add_subcommand(
      "time", "Time engines on a scene; a time counts only beside a passing verdict of its stamp");
  a->scene.add_to(*command);
  a->engines.add_to(*command);
  command->add_option("--repetitions", a->repetitions, "Runs of each engine, alternating")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command
      ->add_option(
          "--processes", a->processes,
          "Processes, each with its own repetitions; compare needs several to tell a change from chance (10 are good)")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->add_option("--narrow-every", a->narrow_every,
                      "Narrow-phase engines measure every k-th frame (default: about 30 frames of the run)");
  command->add_option("--out", a->out, "File for the samples; traces and verdicts beside it are the proof")
      ->capture_default_str();
  command->add_option(
      "--turns", a->turns,
      "Take turns with another process, frame by frame; compare --interleave passes this to both processes");
  add_limits(*command, a->limits);
  command->add_option("--in-process", a->in_process, "Time one cell here and leave its samples in this folder")
      ->group("");
  command->callback([a, &exit] { exit = time(*a); });
}

}  // namespace broadside::bench
