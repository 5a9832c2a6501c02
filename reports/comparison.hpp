// Compares two runs: first whether the change broke anything, then whether it made anything slower.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/rows.hpp"
#include "reports/time_ratio.hpp"

namespace broadside::reports {

enum class ChangeKind {
  kVerdictWorse,    // pass to inconclusive or fail, inconclusive to fail, or a fail where there was no verdict
  kVerdictMissing,  // pass, fail or inconclusive to none or not applicable
  kVerdictBetter,
  kCellVanished,    // no such cell any more
  kCellLost,        // was recorded, and now is absent for the reason that it gives
  kCellNew,         // was not recorded, and now is
  kSceneChanged,    // the same name, another digest: verdicts and times are those of another scene
  kTimeLost,        // was admitted, and now is missing or struck out
  kSeriesVanished,  // a stage was timed, and now is not
  kMoreWork,        // a deterministic counter went up: more box tests, nodes, launches, bytes for the same scene
  kLessWork,
  kCounterVanished,
};

struct Change {
  ChangeKind kind = ChangeKind::kVerdictWorse;
  std::string scene;
  std::string label;
  std::string subject;  // "candidate-set against all-pairs", "cell", "time"
  std::string was;
  std::string is;
  // The effect on the exit code: kFailed for a fail, kMissing for what can no longer be decided, kGood for an
  // improvement.
  core::Exit exit = core::Exit::kGood;
};

struct ComparisonOptions {
  // The smallest change of time that is reported as one, as a share: with 0.05 the interval must lie beyond 1.05. Why 5
  // %: any edit moves code and data in memory, and that alone changes times by a few percent, up to 8 % (Mytkowicz,
  // Diwan, Hauswirth and Sweeney, ASPLOS 2009), so a smaller change says more about the linker than about the edit. A
  // smaller delta finds smaller changes, but also reports those of memory layout; 0 asks only whether there is any
  // difference.
  double delta = 0.05;
  // How many times the times may be evaluated while measuring goes on (ratio_interval).
  std::uint32_t looks = 1;
};

struct Comparison {
  std::vector<Change> changes;  // gravest first, otherwise in the order of the base's rows
  std::vector<TimeRatio> times;
  std::uint64_t same_verdicts = 0;  // judged in both with one outcome
  std::uint64_t still_failing = 0;  // of those: fail in both
  std::uint64_t same_counters = 0;
  double delta = 0.0;                // with which times were compared
  std::uint32_t looks = 1;           // for which the intervals allow
  std::vector<std::string> remarks;  // what a reader must know first, such as different machines

  // kFailed when a verdict fails that did not fail before, a counter went up, or a time is slower; otherwise kMissing
  // when something can no longer be decided or a time is inconclusive; otherwise kGood. A verdict that failed before
  // and still fails is no change. A time that only one side has, or that is from another machine, is not compared and
  // does not count.
  [[nodiscard]] core::Exit exit() const;
};

// Cells are matched by scene name and label, so the builds may differ, and one may have new settings at their defaults.
Comparison compare(const core::RunRows& base, const core::RunRows& head, const ComparisonOptions& options = {});

// Plain text: one sentence, then a line per change and a table of times; within 100 columns where names allow.
std::string comparison_text(const Comparison& comparison);
// The same for machines: {"format": "broadside-comparison", "version": 1, "exit": 0, "changes": [...], "times": [...]}.
std::string comparison_json(const Comparison& comparison);

}  // namespace broadside::reports
