#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cli/commands.hpp"
#include "bench/timing/interleave.hpp"
#include "core/rows.hpp"
#include "reports/comparison.hpp"

namespace broadside::bench {
namespace {

struct CompareArguments {
  std::vector<std::string> what;
  bool is_interleaved = false;
  bool as_json = false;
  reports::ComparisonOptions options;
  InterleavePlan plan;
  std::string folder = "out/compare";
};

core::Result<core::RunRows> rows_of(const std::string& folder) {
  if (!std::filesystem::is_directory(folder))
    return core::Error{"no such folder", folder, "name a folder that run or demo wrote"};
  auto rows = core::read_rows(folder);
  if (rows.ok() && rows.value().cells.empty() && rows.value().verdicts.empty() && rows.value().samples.empty())
    return core::Error{"there is nothing to compare: no cells.json, verdicts.json or samples.json", folder,
                       "run 'broadside run', 'check --json' and 'time' into it first"};
  return rows;
}

core::Result<InterleavedRows> stored(const CompareArguments& a) {
  if (a.what.size() != 2)
    return core::Error{"compare takes two folders, and " + std::to_string(a.what.size()) + " were given", "compare",
                       "write BASE HEAD, or --interleave BIN_BASE BIN_HEAD SCENE..."};
  auto base = rows_of(a.what[0]);
  if (!base) return base.error();
  auto head = rows_of(a.what[1]);
  if (!head) return head.error();
  return InterleavedRows{std::move(base).value(), std::move(head).value()};
}

reports::ComparisonOptions options_of(const CompareArguments& a) {
  reports::ComparisonOptions options = a.options;
  if (a.is_interleaved) options.looks = looks_of(a.plan);
  return options;
}

core::Result<InterleavedRows> in_turns(const CompareArguments& a) {
  if (a.what.size() < 3)
    return core::Error{"two programs and at least one scene are needed", "compare --interleave",
                       "write --interleave BIN_BASE BIN_HEAD SCENE..."};
  InterleavePlan plan = a.plan;
  plan.base = a.what[0];
  plan.head = a.what[1];
  plan.scenes.assign(a.what.begin() + 2, a.what.end());
  plan.folder = a.folder;
  for (const std::string& program : {plan.base, plan.head})
    if (access(program.c_str(), X_OK) != 0 || std::filesystem::is_directory(program))
      return core::Error{"is not a program that can be run", program, "name the file that the build made"};
  if (plan.engines.empty()) plan.engines = {"octree-cpu"};
  const auto untold = [&](const InterleavedRows& rows) {
    std::set<std::string> names;
    for (const reports::TimeRatio& time : reports::compare(rows.base, rows.head, options_of(a)).times)
      if (time.speed == reports::Speed::kInconclusive) names.insert(time.scene);
    return names;
  };
  return run_interleaved(plan, untold);
}

core::Exit compare(const CompareArguments& a) {
  auto rows = a.is_interleaved ? in_turns(a) : stored(a);
  if (!rows) return complain(rows.error());
  const reports::Comparison comparison = reports::compare(rows.value().base, rows.value().head, options_of(a));
  fmt::print("{}", a.as_json ? reports::comparison_json(comparison) : reports::comparison_text(comparison));
  return comparison.exit();
}

}  // namespace

void add_compare(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<CompareArguments>();
  CLI::App* command = program.add_subcommand("compare", "Compare two runs: first what got worse, then what got slower");
  command->add_option("WHAT", a->what, "BASE HEAD: folders of two runs; with --interleave: BIN_BASE BIN_HEAD SCENE...")
      ->required();
  command->add_flag("--interleave", a->is_interleaved,
                    "Run two builds in turns on this machine and compare them pair by pair");
  command
      ->add_option(
          "--delta", a->options.delta,
          "Smallest change of a time that counts, as a fraction. Moving code alone changes times by a few percent, so "
          "with less than 0.05 a change of code layout looks like an effect of the edit")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--engine", a->plan.engines,
                   "With --interleave: an engine to compare (default octree-cpu); may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--processes", a->plan.processes, "With --interleave: timed processes of each build")
      ->check(CLI::Range(6, 100'000))
      ->capture_default_str();
  command
      ->add_option("--most-processes", a->plan.most,
                   "With --interleave: up to this many for scenes whose times are inconclusive, doubled each time; the "
                   "intervals allow for looking more than once")
      ->check(CLI::Range(6, 100'000))
      ->capture_default_str();
  command->add_option("--repetitions", a->plan.repetitions, "With --interleave: timed runs of each process")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->add_option("--frames", a->plan.frames, "With --interleave: frames (default: each scene's own)")
      ->check(more_than_zero, "POSITIVE");
  command->add_flag("--stand-in", a->plan.allow_stand_in, "With --interleave: as in run");
  command->add_option("--out", a->folder, "With --interleave: folder for both builds' rows and traces")
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "Print JSON");
  command->footer(
      "Exits 1 when a verdict got worse, a counter went up or a time is slower; 3 when a result is missing or a time\n"
      "inconclusive. Times are compared only where both sides ran on one machine.");
  command->callback([a, &exit] { exit = compare(*a); });
}

}  // namespace broadside::bench
