#include "bench/contest/contest_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/cell/step_suffix.hpp"
#include "bench/contest/families.hpp"
#include "bench/contest/passage_courses.hpp"

namespace broadside::bench::contest {
namespace {

constexpr auto kRecorded = core::CellState::kRecorded;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

SceneTable& table_of(std::vector<SceneTable>& scenes, const std::string& scene) {
  for (SceneTable& s : scenes)
    if (s.scene == scene) return s;
  scenes.push_back({scene, {}, {}});
  return scenes.back();
}

// Runs of passages that are no scenes of the contest.
std::set<std::string> fast_scenes(const std::map<std::string, double>& scenes) {
  std::set<std::string> names;
  for (const PassageCourse& course : passage_courses())
    for (const PassageRun& run : course.runs)
      if (const std::string name = name_and_step(run.scene).first; scenes.count(name) == 0) names.insert(name);
  return names;
}

std::string_view passage_word(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kPass:
      return "held";
    case core::Outcome::kFail:
      return "through";
    case core::Outcome::kInconclusive:
      return "undecided";
    case core::Outcome::kNotApplicable:
      break;
  }
  return "nothing met";
}

double median(std::vector<double> values) {
  if (values.empty()) return kNone;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The median time of a run's frames, s.
double frame_s(const core::Sample& sample) {
  for (const core::StageSeries& stage : sample.stages)
    if (stage.stage == "frame") return median(stage.seconds);
  return kNone;
}

void add_verdicts(Entry& entry, const core::CellVerdicts& judged) {
  entry.coverage = core::coverage_of(judged.verdicts);
  for (const core::Verdict& v : judged.verdicts) {
    if (v.outcome == core::Outcome::kFail) entry.broken.push_back(v);
    // Where a limit is a lower bound, a law holds above it: its share says nothing about how near the limit is.
    if (v.outcome == core::Outcome::kPass && share_of_limit(v) <= 1.0 &&
        (!entry.has_nearest || share_of_limit(v) > share_of_limit(entry.nearest))) {
      entry.nearest = v;
      entry.has_nearest = true;
    }
    entry.is_motion_proven = entry.is_motion_proven || core::proves_motion(v);
    const bool applied = v.outcome == core::Outcome::kPass || v.outcome == core::Outcome::kFail;
    if (v.validator == "closed-form" && applied) {
      entry.error = v.measured;
      entry.error_unit = v.unit;
    }
    if (v.validator == "rest" && applied) {
      entry.has_rest = true;
      entry.rest = v.measured;
      entry.rest_unit = v.unit;
      entry.stands = v.outcome == core::Outcome::kPass;
    }
    if (v.validator == "passage") {
      entry.passage = passage_word(v.outcome);
      entry.passage_words = v.explanation;
    }
    if (v.validator == "penetration" && applied) entry.deepest_m = v.measured;
  }
}

const core::CellVerdicts* verdicts_of(const core::RunRows& rows, const core::Cell& cell) {
  for (const core::CellVerdicts& v : rows.verdicts)
    if (!cell.trace_file.empty() && v.trace_file == cell.trace_file) return &v;
  return nullptr;
}

// "id[a=1,threads=2]" without the number of threads, and whether it had one.
std::pair<std::string, bool> without_threads(std::string label) {
  constexpr std::string_view kKey = "threads=";
  const auto at = label.find(kKey);
  if (at == std::string::npos || at == 0 || (label[at - 1] != '[' && label[at - 1] != ',')) return {label, false};
  const auto end = label.find_first_of(",]", at);
  const bool is_first = label[at - 1] == '[';
  const bool is_last = end == std::string::npos || label[end] == ']';
  if (is_first && is_last) return {label.substr(0, at - 1), true};
  if (is_last) return {label.substr(0, at - 1) + "]", true};
  label.erase(at, end + 1 - at);
  return {label, true};
}

bool is_of(const core::Sample& sample, const core::Cell& cell) {
  return sample.stamp.scene_digest == cell.stamp.scene_digest && sample.stamp.engine == cell.stamp.engine &&
         sample.stamp.settings == cell.stamp.settings;
}

}  // namespace

std::pair<std::string, std::string> name_and_step(const std::string& scene_name) {
  const auto [name, dt_s] = split_step(scene_name);
  return {std::string(name), dt_s ? scene_name.substr(name.size() + 1) : std::string()};
}

ContestTable contest_table(const core::RunRows& rows, const std::vector<Entrant>& entrants,
                           const std::map<std::string, double>& steps_s) {
  ContestTable table;
  table.entrants = entrants;
  const std::set<std::string> fast = fast_scenes(steps_s);
  for (const core::Cell& cell : rows.cells) {
    const auto [scene, step] = name_and_step(cell.stamp.scene_name);
    SceneTable& place = table_of(fast.count(scene) > 0 ? table.fast_scenes : table.scenes, scene);
    if (std::find(place.steps.begin(), place.steps.end(), step) == place.steps.end()) place.steps.push_back(step);
    const std::string label = cell.stamp.label();
    Entry entry;
    entry.state = cell.state;
    entry.reason = cell.reason;
    entry.error = entry.cost = entry.rest = entry.deepest_m = kNone;
    entry.trace_file = cell.trace_file;
    if (!cell.digests.empty()) entry.last_digest = cell.digests.rbegin()->second;
    const bool is_entrant =
        std::any_of(entrants.begin(), entrants.end(), [&](const Entrant& e) { return e.engine == label; });
    if (const auto [alone, has_threads] = without_threads(label); has_threads && !is_entrant) {
      if (entry.state == kRecorded) place.thread_digests[alone].insert(entry.last_digest);
      continue;
    }
    const auto own = steps_s.find(scene);
    entry.dt_s = split_step(cell.stamp.scene_name).second.value_or(own == steps_s.end() ? kNone : own->second);
    if (const core::CellVerdicts* judged = verdicts_of(rows, cell)) {
      add_verdicts(entry, *judged);
      table.declarations[label] = judged->declaration;
    }
    for (const core::Sample& sample : rows.samples) {
      if (!is_of(sample, cell)) continue;
      const double seconds = frame_s(sample) / entry.dt_s;
      entry.cost = entry.was_timed ? std::fmin(entry.cost, seconds) : seconds;
      const auto recorded = cell.digests.find(sample.final_step);
      const bool is_same = recorded != cell.digests.end() && recorded->second == sample.final_digest;
      entry.repeats = is_same && (!entry.was_timed || entry.repeats);
      entry.was_timed = true;
    }
    if (!cell.stamp.engine_build.empty()) table.builds[label] = cell.stamp.engine_build;
    place.entries[label][step] = std::move(entry);
  }
  // The page may be made on a machine without the engines, from cells that another machine ran.
  for (Entrant& e : table.entrants)
    if (table.builds.count(e.engine) > 0) e.absent.clear();
  return table;
}

const Entry* own_entry(const SceneTable& scene, const std::string& engine) {
  const auto of = scene.entries.find(engine);
  if (of == scene.entries.end()) return nullptr;
  const auto own = of->second.find("");
  return own == of->second.end() ? nullptr : &own->second;
}

std::string entry_text(const Entry& entry) {
  if (entry.state != core::CellState::kRecorded)
    return std::string(core::cell_state_word(entry.state)) +
           (entry.reason.empty() ? "" : ": " + entry.reason.substr(0, entry.reason.find(';')));
  const core::LawCount& laws = entry.coverage.of(core::LawKind::kMechanics);
  const std::string counted = fmt::format("{} of {}", laws.applied, laws.laws);
  if (entry.broken.empty()) return (entry.coverage.applied() == 0 ? "nothing judged, " : "holds, ") + counted;
  std::string names;
  for (const core::Verdict& v : entry.broken) names += (names.empty() ? "" : ", ") + v.validator;
  return "breaks " + names + "; " + counted;
}

}  // namespace broadside::bench::contest
