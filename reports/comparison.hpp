// Two runs side by side: did the change break anything, then did it make anything slower? Correctness comes first.
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
  kCellVanished,  // no such cell any more
  kCellLost,      // was recorded, and now is absent for the reason that it gives
  kCellNew,       // was not recorded, and now is
  kSceneChanged,  // the same name, another digest: its verdicts and times are of something else
  kTimeLost,      // was admitted, and now is missing or struck out
};

struct Change {
  ChangeKind kind = ChangeKind::kVerdictWorse;
  std::string scene;
  std::string label;
  std::string subject;  // "candidate-set against all-pairs", "cell", "time"
  std::string was;
  std::string is;
  // What it does to the exit code: kFailed for a fail, kMissing for what can no longer be told, kGood for good news.
  core::Exit exit = core::Exit::kGood;
};

struct ComparisonOptions {
  // Runs of one build on one machine differ between days by a few percent (page placement, clock, temperature), which
  // runs of one day do not show. A share; larger hides small regressions, smaller reports the weather.
  double slack = 0.05;
};

struct Comparison {
  std::vector<Change> changes;  // gravest first, otherwise in the order of the base's rows
  std::vector<TimeRatio> times;
  std::uint64_t same_verdicts = 0;  // judged in both with one outcome
  std::uint64_t still_failing = 0;  // of those: fail in both

  // kFailed when a verdict fails that did not, or a time is slower; otherwise kMissing when something can no longer be
  // told; otherwise kGood. What failed before and still fails is no change.
  [[nodiscard]] core::Exit exit() const;
};

// Cells are matched by scene name and label, so that builds and new settings at their defaults may differ.
Comparison compare(const core::RunRows& base, const core::RunRows& head, const ComparisonOptions& options = {});

// Plain text: one sentence, then a line per change and a table of times; within 100 columns where names allow.
std::string comparison_text(const Comparison& comparison);

}  // namespace broadside::reports
