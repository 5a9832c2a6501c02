#include "bench/bisect/time_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include "bench/process/program.hpp"
#include "bench/process/progress.hpp"
#include "bench/record/run_plan.hpp"
#include "bench/timing/interleave.hpp"
#include "reports/comparison.hpp"

namespace broadside::bench::bisect {
namespace {

namespace fs = std::filesystem;

InterleavePlan plan_of(const TimeSettings& settings) {
  InterleavePlan plan;
  plan.processes = settings.processes;
  plan.most = settings.most;
  return plan;
}

reports::ComparisonOptions options_of(const TimeSettings& settings) {
  return {settings.delta, looks_of(plan_of(settings))};
}

std::vector<reports::TimeRatio> ratios(const TimeSettings& settings, const InterleavedRows& rows) {
  return reports::compare(rows.base, rows.head, options_of(settings)).times;
}

bool is_told(const std::vector<reports::TimeRatio>& times) {
  return std::none_of(times.begin(), times.end(),
                      [](const auto& time) { return time.speed == reports::Speed::kInconclusive; });
}

core::Status write_side(const fs::path& folder, const core::RunRows& rows) {
  if (core::Status s = core::write_cells(folder / "cells.json", rows.cells); !s) return s;
  if (core::Status s = core::write_verdicts(folder / "verdicts.json", rows.verdicts); !s) return s;
  return core::write_samples(folder / "samples.json", rows.samples);
}

// Runs the command once and adds its samples under the number of the pair; cells and verdicts are those of the first.
core::Status time_once(const TimedWork& work, const BuildPlace& place, std::uint64_t pair, const fs::path& folder,
                       core::RunRows& rows) {
  const fs::path out = fs::absolute(folder) / ("pair-" + std::to_string(pair));
  if (core::Status s = prepare_folder(out); !s) return s;
  const fs::path log = folder / "command.log";
  const auto code = run_in_shell(filled_in(work.command, place, out), fs::current_path(), log, work.lock);
  if (!code) return code.error();
  auto own = core::read_rows(out);
  if (!own) return own.error();
  if (own.value().samples.empty())
    return core::Error{fmt::format("the command exits {} and leaves no samples.json{}", code.value(), said_in(log)),
                       place.build.string(), "let it call 'broadside time ... --out {out}/samples.json'",
                       core::Exit::kMissing};
  for (core::Sample& sample : own.value().samples) {
    sample.process = pair;
    rows.samples.push_back(std::move(sample));
  }
  if (pair == 1) {
    rows.cells = std::move(own.value().cells);
    rows.verdicts = std::move(own.value().verdicts);
  }
  std::error_code ignored;
  fs::remove_all(out, ignored);
  return core::Done{};
}

core::Status time_command(const TimedWork& work, const TimeSettings& settings, const BuildPlace& good,
                          const BuildPlace& build, const fs::path& folder) {
  InterleavedRows rows;
  const std::array<fs::path, 2> folders{folder / "base", folder / "head"};
  for (const fs::path& side : folders)
    if (core::Status s = prepare_folder(side); !s) return s;
  std::uint64_t pairs = 0;
  for (std::uint64_t until = settings.processes;; until = std::min<std::uint64_t>(2 * until, settings.most)) {
    Progress progress("comparing", until);
    while (pairs < until) {
      ++pairs;
      for (const bool is_first : {true, false}) {
        const bool is_good = is_first == (pairs % 2 == 1);
        if (core::Status s = time_once(work, is_good ? good : build, pairs, folders[is_good ? 0 : 1],
                                       is_good ? rows.base : rows.head);
            !s)
          return s;
      }
      progress.at(pairs);
    }
    if (until >= settings.most || is_told(ratios(settings, rows))) break;
  }
  if (core::Status s = write_side(folders[0], rows.base); !s) return s;
  return write_side(folders[1], rows.head);
}

core::Status time_scene(const TimedWork& work, const TimeSettings& settings, const BuildPlace& good,
                        const BuildPlace& build, const fs::path& folder) {
  InterleavePlan plan = plan_of(settings);
  plan.base = good.program.string();
  plan.head = build.program.string();
  plan.scenes = {work.scene};
  plan.engines = work.engines;
  plan.allow_stand_in = work.allow_stand_in;
  plan.frames = work.frames;
  plan.folder = folder;
  const auto untold = [&](const InterleavedRows& rows) {
    std::set<std::string> names;
    for (const reports::TimeRatio& time : ratios(settings, rows))
      if (time.speed == reports::Speed::kInconclusive) names.insert(time.scene);
    return names;
  };
  const auto done = run_interleaved(plan, untold);
  if (!done) return done.error();
  return core::Done{};
}

std::string percent_text(double ratio) {
  return fmt::format("{:+.1f} %", 100.0 * (ratio - 1.0));
}

}  // namespace

core::Result<std::vector<reports::TimeRatio>> measure_times(const TimedWork& work, const TimeSettings& settings,
                                                            const BuildPlace& good, const BuildPlace& build,
                                                            const fs::path& folder) {
  const core::Status done = work.scene.empty() ? time_command(work, settings, good, build, folder)
                                               : time_scene(work, settings, good, build, folder);
  if (!done) return done.error();
  return read_times(settings, folder);
}

core::Result<std::vector<reports::TimeRatio>> read_times(const TimeSettings& settings, const fs::path& folder) {
  auto base = core::read_rows(folder / "base");
  if (!base) return base.error();
  auto head = core::read_rows(folder / "head");
  if (!head) return head.error();
  return ratios(settings, {std::move(base).value(), std::move(head).value()});
}

std::vector<Difference> time_differences(const std::vector<reports::TimeRatio>& times) {
  std::vector<Difference> found;
  for (const reports::TimeRatio& time : times) {
    const bool is_slower = time.speed == reports::Speed::kSlower;
    if (is_slower || time.speed == reports::Speed::kFaster)
      found.push_back({time.scene, time.label, "time per frame", "1",
                       fmt::format("{:.3f} of the good build's, {} ({} to {})", time.ratio,
                                   is_slower ? "slower" : "faster", percent_text(time.low), percent_text(time.high))});
  }
  return found;
}

}  // namespace broadside::bench::bisect
