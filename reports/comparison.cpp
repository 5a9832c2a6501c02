#include "reports/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "reports/admission.hpp"
#include "reports/figures.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

using core::Exit;
using core::Outcome;

// Everything that a run says about one (scene name, label).
struct Entry {
  std::string scene, label;
  std::uint64_t digest = 0;
  const core::Cell* cell = nullptr;  // a recorded one, when there is any
  // The gravest outcome by validator and baseline; in order of first appearance.
  std::vector<std::pair<std::string, Outcome>> verdicts;
};

Entry& entry_of(std::vector<Entry>& entries, const core::Stamp& stamp) {
  const std::string label = stamp.label();
  for (Entry& entry : entries)
    if (entry.scene == stamp.scene_name && entry.label == label) return entry;
  entries.push_back({.scene = stamp.scene_name, .label = label, .digest = stamp.scene_digest});
  return entries.back();
}

std::vector<Entry> entries_of(const core::RunRows& rows) {
  std::vector<Entry> entries;
  for (const core::Cell& cell : rows.cells) {
    Entry& entry = entry_of(entries, cell.stamp);
    if (entry.cell == nullptr || entry.cell->state != core::CellState::kRecorded) entry.cell = &cell;
  }
  for (const core::CellVerdicts& judged : rows.verdicts) {
    Entry& entry = entry_of(entries, judged.stamp);
    for (const core::Verdict& verdict : judged.verdicts) {
      const std::string name =
          verdict.baseline.empty() ? verdict.validator : verdict.validator + " against " + verdict.baseline;
      const auto known =
          std::find_if(entry.verdicts.begin(), entry.verdicts.end(), [&](const auto& v) { return v.first == name; });
      if (known == entry.verdicts.end()) {
        entry.verdicts.emplace_back(name, verdict.outcome);
      } else if (severity(verdict.outcome) > severity(known->second)) {
        known->second = verdict.outcome;
      }
    }
  }
  return entries;
}

const Entry* find(const std::vector<Entry>& entries, const Entry& like) {
  for (const Entry& entry : entries)
    if (entry.scene == like.scene && entry.label == like.label) return &entry;
  return nullptr;
}

std::optional<Outcome> outcome_of(const Entry& entry, const std::string& name) {
  for (const auto& [known, outcome] : entry.verdicts)
    if (known == name) return outcome;
  return std::nullopt;
}

bool is_recorded(const Entry& entry) {
  return entry.cell != nullptr && entry.cell->state == core::CellState::kRecorded;
}

std::string words(const std::optional<Outcome>& outcome) {
  return outcome ? std::string(core::outcome_word(*outcome)) : "no verdict";
}

// "Not applicable" says as little about the law as a missing verdict.
bool is_silent(const std::optional<Outcome>& outcome) {
  return !outcome || *outcome == Outcome::kNotApplicable;
}

// " (12.5 % more)"
std::string more_or_less(std::uint64_t was, std::uint64_t is) {
  if (was == 0) return "";
  const double share = static_cast<double>(is) / static_cast<double>(was) - 1.0;
  return " (" + percent(std::abs(share)) + (share > 0.0 ? " more)" : " less)");
}

// The stages for which a run has times, by cell.
std::map<std::pair<std::string, std::string>, std::set<std::string>> stages_of(const core::RunRows& rows) {
  std::map<std::pair<std::string, std::string>, std::set<std::string>> stages;
  for (const core::Sample& sample : rows.samples)
    for (const core::StageSeries& series : sample.stages)
      stages[{sample.stamp.scene_name, sample.stamp.label()}].insert(series.stage);
  return stages;
}

std::set<std::string> machines_of(const core::RunRows& rows) {
  std::set<std::string> machines;
  for (const core::Cell& cell : rows.cells) machines.insert(cell.stamp.machine);
  for (const core::Sample& sample : rows.samples) machines.insert(sample.stamp.machine);
  return machines;
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " and ") + name;
  return text;
}

class Comparer {
 public:
  explicit Comparer(Comparison& result) : result_(result) {}

  void cell(const Entry& was, const Entry* is) {
    if (is == nullptr) {
      add(was, ChangeKind::kCellVanished, "cell", was.cell != nullptr ? state_text(*was.cell) : "judged", "gone",
          Exit::kMissing);
      return;
    }
    if (was.digest != is->digest)
      add(was, ChangeKind::kSceneChanged, "scene", "one digest", "another digest", Exit::kMissing);
    if (is_recorded(was) && !is_recorded(*is))
      add(was, ChangeKind::kCellLost, "cell", "recorded", is->cell != nullptr ? state_text(*is->cell) : "no cell",
          Exit::kMissing);
    if (was.cell != nullptr && !is_recorded(was) && is_recorded(*is))
      add(was, ChangeKind::kCellNew, "cell", state_text(*was.cell), "recorded", Exit::kGood);
    if (is_recorded(was) && is_recorded(*is) && was.digest == is->digest && was.cell->frames == is->cell->frames)
      counters(was, *is);
  }

  // Counters do not depend on the machine or the day, so they are compared across machines and without tolerance.
  void counters(const Entry& was, const Entry& is) {
    for (const auto& [name, count] : was.cell->counters) {
      const auto now = is.cell->counters.find(name);
      if (now == is.cell->counters.end()) {
        add(was, ChangeKind::kCounterVanished, name, counted(count), "not counted", Exit::kMissing);
      } else if (now->second > count) {
        add(was, ChangeKind::kMoreWork, name, counted(count), counted(now->second) + more_or_less(count, now->second),
            Exit::kFailed);
      } else if (now->second < count) {
        add(was, ChangeKind::kLessWork, name, counted(count), counted(now->second) + more_or_less(count, now->second),
            Exit::kGood);
      } else {
        ++result_.same_counters;
      }
    }
  }

  void verdict(const Entry& where, const std::string& name, std::optional<Outcome> was, std::optional<Outcome> is) {
    if (is_silent(was) && is_silent(is)) return;
    if (is_silent(is)) return add(where, ChangeKind::kVerdictMissing, name, words(was), words(is), Exit::kMissing);
    if (!is_silent(was) && *was == *is) {
      ++result_.same_verdicts;
      if (*is == Outcome::kFail) ++result_.still_failing;
      return;
    }
    // A new verdict counts by its outcome: a pass is an improvement, a fail is not.
    const int before = is_silent(was) ? severity(Outcome::kPass) : severity(*was);
    if (severity(*is) > before) {
      add(where, ChangeKind::kVerdictWorse, name, words(was), words(is),
          *is == Outcome::kFail ? Exit::kFailed : Exit::kMissing);
    } else {
      add(where, ChangeKind::kVerdictBetter, name, words(was), words(is), Exit::kGood);
    }
  }

  void add(const Entry& where, ChangeKind kind, const std::string& subject, const std::string& was,
           const std::string& is, Exit exit) {
    result_.changes.push_back({kind, where.scene, where.label, subject, was, is, exit});
  }

 private:
  Comparison& result_;
};

int gravity(const Change& change) {
  return change.exit == Exit::kFailed ? 2 : change.exit == Exit::kMissing ? 1 : 0;
}

}  // namespace

core::Exit Comparison::exit() const {
  bool is_missing = false;
  for (const TimeRatio& time : times) {
    if (time.speed == Speed::kSlower) return Exit::kFailed;
    is_missing = is_missing || time.speed == Speed::kInconclusive;
  }
  for (const Change& change : changes) {
    if (change.exit == Exit::kFailed) return Exit::kFailed;
    is_missing = is_missing || change.exit == Exit::kMissing;
  }
  return is_missing ? Exit::kMissing : Exit::kGood;
}

Comparison compare(const core::RunRows& base, const core::RunRows& head, const ComparisonOptions& options) {
  Comparison result;
  Comparer comparer(result);
  const std::vector<Entry> before = entries_of(base);
  const std::vector<Entry> after = entries_of(head);

  for (const Entry& was : before) {
    const Entry* is = find(after, was);
    comparer.cell(was, is);
    if (is == nullptr) continue;
    for (const auto& [name, outcome] : was.verdicts) comparer.verdict(was, name, outcome, outcome_of(*is, name));
    for (const auto& [name, outcome] : is->verdicts)
      if (!outcome_of(was, name)) comparer.verdict(was, name, std::nullopt, outcome);
  }
  for (const Entry& is : after) {
    if (find(before, is) != nullptr) continue;
    if (is_recorded(is)) comparer.add(is, ChangeKind::kCellNew, "cell", "no cell", "recorded", Exit::kGood);
    for (const auto& [name, outcome] : is.verdicts) comparer.verdict(is, name, std::nullopt, outcome);
  }

  result.delta = options.delta;
  const std::set<std::string> old_machines = machines_of(base);
  const std::set<std::string> new_machines = machines_of(head);
  if (!old_machines.empty() && !new_machines.empty() && old_machines != new_machines)
    result.remarks.push_back("different machines: the base ran on " + listed(old_machines) + ", the head on " +
                             listed(new_machines) + "; verdicts and counters are compared, times are not");
  const auto new_stages = stages_of(head);
  for (const auto& [key, stages] : stages_of(base)) {
    const auto now = new_stages.find(key);
    if (now == new_stages.end()) continue;  // the time itself is missing, which is reported below
    for (const std::string& stage : stages)
      if (!now->second.contains(stage))
        comparer.add({.scene = key.first, .label = key.second}, ChangeKind::kSeriesVanished, "times of stage " + stage,
                     "measured", "gone", Exit::kMissing);
  }
  result.times = time_ratios(base, head, options.delta, options.looks);
  result.looks = options.looks;
  for (const TimeRatio& time : result.times) {
    const bool is_lost = time.reason.starts_with("the head has no time") || time.reason.starts_with("the head's time");
    if (is_lost)
      comparer.add({.scene = time.scene, .label = time.label}, ChangeKind::kTimeLost, "time", "admitted", time.reason,
                   Exit::kMissing);
  }
  std::stable_sort(result.changes.begin(), result.changes.end(),
                   [](const Change& a, const Change& b) { return gravity(a) > gravity(b); });
  return result;
}

}  // namespace broadside::reports
