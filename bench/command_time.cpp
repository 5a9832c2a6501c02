#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "bench/commands.hpp"
#include "bench/engines.hpp"
#include "bench/run_plan.hpp"
#include "bench/scene_arguments.hpp"
#include "bench/timing.hpp"
#include "reports/terminal_times.hpp"
#include "reports/timing.hpp"

namespace broadside::bench {
namespace {

struct TimeArguments {
  SceneArguments scene;
  EngineArguments engines;
  std::uint32_t repetitions = 5;
  std::uint32_t narrow_every = 0;
  std::string out = "out/samples.json";
};

core::Exit time(const TimeArguments& a) {
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

  core::Exit exit = core::Exit::kGood;
  for (const CellSpec& spec : plan.cells) {
    const std::string reason = why_absent(*spec.row);
    if (reason.empty()) continue;
    fmt::print("{}: not measured: {}\n", spec.row->id, reason);
    exit = core::Exit::kMissing;
  }
  auto samples = time_plan(plan, a.repetitions);
  if (!samples) return complain(samples.error());
  // Beside recorded cells and their verdicts a time is admitted or struck out; alone it is a number without a proof.
  auto rows = core::read_rows(plan.folder);
  if (!rows) return complain(rows.error());
  rows.value().samples = samples.value();
  fmt::print("{}", reports::timing_table(reports::pool_samples(rows.value())));
  if (core::Status s = core::write_samples(out, samples.value()); !s) return complain(s.error());
  return exit;
}

}  // namespace

void add_time(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<TimeArguments>();
  CLI::App* command = program.add_subcommand(
      "time", "Time engines on a scene; a time counts only beside a passing verdict of its stamp");
  a->scene.add_to(*command);
  a->engines.add_to(*command);
  command->add_option("--repetitions", a->repetitions, "Runs of each engine, alternating")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--narrow-every", a->narrow_every,
                      "Narrow-phase engines measure every k-th frame (default: about 30 frames of the run)");
  command->add_option("--out", a->out, "File for the samples; traces and verdicts beside it are the proof")
      ->capture_default_str();
  command->callback([a, &exit] { exit = time(*a); });
}

}  // namespace broadside::bench
