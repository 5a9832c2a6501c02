#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/forensics/difference_text.hpp"
#include "bench/forensics/replay.hpp"
#include "bench/process/scratch_folder.hpp"
#include "bench/record/run_plan.hpp"

namespace broadside::bench {
namespace {

struct ReplayArguments {
  std::string trace;
  EngineArguments engines;
  std::string capability;
  std::string folder;
  bool as_json = false;
};

core::Exit tell(const ReplayArguments& a, const Replay& replay) {
  auto recorded = core::TraceReader::open(a.trace);
  if (!recorded) return complain(recorded.error());
  auto own = core::TraceReader::open(replay.file);
  if (!own) return complain(own.error());
  const TraceDifference& d = replay.difference;
  if (a.as_json) {
    fmt::print("{}", difference_json(recorded.value(), own.value(), d));
  } else {
    fmt::print("Repeated: {}\nExpected: {}\n{}", replay.capability, replay.expectation,
               difference_text(recorded.value(), own.value(), d));
    if (!replay.remark.empty()) fmt::print("\n{}\n", replay.remark);
    if (d.is_same() && !replay.has_judged) fmt::print("Nothing could be judged.\n");
  }
  if (!d.is_same()) return core::Exit::kFailed;
  return replay.has_judged ? core::Exit::kGood : core::Exit::kMissing;
}

core::Exit replay(const ReplayArguments& a) {
  auto cells = a.engines.make();
  if (!cells) return complain(cells.error());
  if (cells.value().size() != 1) return complain({"more than one engine", "--engine", "replay runs one"});
  const CellSpec& engine = cells.value().front();
  if (const std::string reason = engine.row->absent != nullptr ? engine.row->absent() : ""; !reason.empty())
    return complain(
        {"not measured: " + reason, std::string(engine.row->id), "choose another engine", core::Exit::kMissing});
  const ScratchFolder scratch;
  const std::filesystem::path folder = a.folder.empty() ? scratch.path() : std::filesystem::path(a.folder);
  if (core::Status s = prepare_folder(folder); !s) return complain(s.error());
  const auto replayed = replay_trace(a.trace, engine, a.capability, folder);
  if (!replayed) return complain(replayed.error());
  return tell(a, replayed.value());
}

}  // namespace

void add_replay(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ReplayArguments>();
  CLI::App* command = program.add_subcommand(
      "replay", "Run an engine on the scene, boxes or poses of any trace, and compare with what the trace recorded");
  command->add_option("TRACE", a->trace, "A trace (.h5)")->required();
  a->engines.add_to(*command);
  command
      ->add_option("--as", a->capability, "What to repeat (default: whatever the trace and the engine have in common)")
      ->check(CLI::IsMember({"dynamics", "broad", "narrow"}));
  command->add_option("--out", a->folder, "Keep the engine's own trace in this folder");
  command->add_flag("--json", a->as_json, "The comparison as JSON");
  command->footer("Exit codes: 0 it agrees; 1 it does not; 2 bad input; 3 nothing could be judged.");
  command->callback([a, &exit] { exit = replay(*a); });
}

}  // namespace broadside::bench
