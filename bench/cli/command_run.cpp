#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "bench/campaign/run_cells.hpp"
#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/limit_arguments.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/record/record.hpp"
#include "bench/record/run_plan.hpp"
#include "reports/cells_json.hpp"
#include "reports/figures.hpp"
#include "reports/terminal_table.hpp"

namespace broadside::bench {
namespace {

struct RunArguments {
  SceneArguments scene;
  EngineArguments engines;
  std::string level = "full";
  std::uint32_t every = 1;
  std::vector<std::string> windows;
  bool resume = false;
  std::uint32_t narrow_every = 0;
  std::string folder = "out";
  std::string driver;
  std::string in_process;  // the folder for the row of the one cell
  ChildLimits limits;
  std::string cell;   // of a campaign, whose folder is then given as SCENE
  std::string shard;  // likewise
  bool as_json = false;
};

core::RecordLevel level_named(const std::string& name) {
  if (name == "digest") return core::RecordLevel::kDigest;
  if (name == "none") return core::RecordLevel::kNone;
  return core::RecordLevel::kFull;
}

core::Result<RunPlan> make_plan(const RunArguments& a) {
  RunPlan plan;
  auto scene = a.scene.make();
  if (!scene) return scene.error();
  plan.source = a.scene;
  plan.scene = std::move(scene).value();
  auto cells = a.engines.make();
  if (!cells) return cells.error();
  plan.cells = std::move(cells).value();
  plan.frames = plan.scene.frames;
  plan.level = level_named(a.level);
  auto selection = StepSelection::parse(a.every, a.windows);
  if (!selection) return selection.error();
  plan.selection = std::move(selection).value();
  plan.narrow_every = a.narrow_every > 0 ? a.narrow_every : default_narrow_every(plan.frames);
  plan.folder = a.folder;
  plan.reuse = plan.resume = a.resume;
  if (plan.resume && plan.level != core::RecordLevel::kFull)
    return core::Error{"a run goes on from recorded states, and --record " + a.level + " records none", "--resume",
                       "record full, or leave out --resume"};
  plan.limits = a.limits;
  return plan;
}

// Records one cell in this process; record_cell_in_child starts this.
core::Exit run_in_process(const RunArguments& a, const RunPlan& plan) {
  const CellSpec& spec = plan.cells.front();
  const CellRequest request{plan.source,    &plan.scene,       spec.row,    spec.settings, plan.frames, plan.level,
                            plan.selection, plan.narrow_every, plan.folder, a.driver,      plan.resume};
  auto cell = record_cell(request);
  if (!cell) return complain(cell.error());
  // The parent made this folder. It is missing only when a command is repeated by hand after the parent removed it.
  if (core::Status s = prepare_folder(a.in_process); !s) return complain(s.error());
  if (core::Status s = core::write_cells(std::filesystem::path(a.in_process) / "cells.json", {cell.value()}); !s)
    return complain(s.error());
  return cell.value().state == core::CellState::kRecorded ? core::Exit::kGood : core::Exit::kMissing;
}

// SCENE is then the folder that `broadside plan` made.
core::Exit run_campaign(const RunArguments& a) {
  campaign::Selection selection;
  selection.id = a.cell;
  if (!a.shard.empty()) {
    auto shard = campaign::Selection::of_shard(a.shard);
    if (!shard) return complain(shard.error());
    selection = shard.value();
  }
  const auto tell = [](const campaign::GroupEnd& end) {
    for (const campaign::ManifestCell& cell : end.cells)
      fmt::print("{} {}: {} on {}{}\n", cell.id, end.word, cell.work.engine, cell.work.scene,
                 &cell == &end.cells.back() ? fmt::format(", {:.1f} s", end.seconds) : "");
    std::fflush(stdout);
  };
  auto tally = campaign::run_cells(a.scene.spec, selection, tell);
  if (!tally) return complain(tally.error());
  const campaign::Tally& t = tally.value();
  fmt::print("{} cells done, {} done before, {} running elsewhere, {} unfinished\n", t.done, t.there, t.busy,
             t.unfinished);
  return t.busy + t.unfinished == 0 ? core::Exit::kGood : core::Exit::kMissing;
}

std::string summary(const RunOutcome& outcome, const std::string& folder) {
  std::uint64_t recorded = 0;
  double seconds = 0.0;
  for (const core::Cell& cell : outcome.cells) {
    recorded += cell.state == core::CellState::kRecorded ? 1U : 0U;
    seconds += cell.wall_s;
  }
  return fmt::format("{} of {} recorded in {}; traces and cells.json are in {}\n", recorded,
                     reports::counted(outcome.cells.size(), "cell"), reports::quantity(seconds, "s"), folder);
}

core::Exit run(const RunArguments& a) {
  if (!a.cell.empty() || !a.shard.empty()) return run_campaign(a);
  if (a.engines.is_empty())
    return complain({"no engine was named", "--engine", "name one that 'broadside list engines' shows"});
  if (!a.in_process.empty()) limit_this_process(a.limits.memory_mib);
  auto plan = make_plan(a);
  if (!plan) return complain(plan.error());
  if (core::Status s = prepare_folder(plan.value().folder); !s) return complain(s.error());
  if (!a.in_process.empty()) return run_in_process(a, plan.value());
  auto outcome = run_plan(plan.value());
  if (!outcome) return complain(outcome.error());
  if (a.as_json)
    fmt::print("{}", reports::cells_json(outcome.value().cells));
  else
    fmt::print("{}{}", reports::cell_table(outcome.value().cells), summary(outcome.value(), a.folder));
  for (const core::Cell& cell : outcome.value().cells)
    if (cell.state != core::CellState::kRecorded) return core::Exit::kMissing;
  return core::Exit::kGood;
}

}  // namespace

void add_run(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<RunArguments>();
  CLI::App* command = program.add_subcommand("run", "Run engines over a scene and record a trace of each");
  a->scene.add_to(*command);
  a->engines.add_to(*command);
  CLI::Option* cell = command->add_option("--cell", a->cell, "Run only this cell of the campaign in the folder SCENE");
  command->add_option("--shard", a->shard, "Run the i-th of n shares of the campaign in the folder SCENE: i/n")
      ->excludes(cell);
  command->add_option("--record", a->level, "What to record: full, digest (one number a frame) or none")
      ->check(CLI::IsMember({"full", "digest", "none"}))
      ->capture_default_str();
  command->add_option("--every", a->every, "Record every k-th frame")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->add_option(
      "--window", a->windows,
      "Record only steps FIRST:LAST, such as 100:200; may be repeated. The last step is always recorded");
  command->add_flag("--resume", a->resume,
                    "Continue the traces that an earlier run of the same stamp left in --out; complete ones stay");
  command->add_option("--narrow-every", a->narrow_every,
                      "Narrow-phase engines measure every k-th frame (default: about 30 frames of the run)");
  command->add_option("--out", a->folder, "Folder for the traces and cells.json")->capture_default_str();
  add_limits(*command, a->limits);
  command->add_flag("--json", a->as_json, "Print the cells as JSON instead of a table");
  command->add_option("--driver", a->driver, "Trace that feeds engines that do not simulate")->group("");
  command->add_option("--in-process", a->in_process, "Run one cell here and leave its row in this folder")->group("");
  command->callback([a, &exit] { exit = run(*a); });
}

}  // namespace broadside::bench
