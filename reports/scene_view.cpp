#include "reports/scene_view.hpp"

#include <algorithm>
#include <set>

#include "reports/figures.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

SceneView& scene_of(std::vector<SceneView>& scenes, const core::Stamp& stamp) {
  for (SceneView& scene : scenes)
    if (scene.digest == stamp.scene_digest && scene.name == stamp.scene_name) return scene;
  scenes.push_back({.name = stamp.scene_name, .digest = stamp.scene_digest});
  return scenes.back();
}

TraceView& trace_of(SceneView& scene, const core::Stamp& stamp, const std::string& trace_file) {
  for (TraceView& trace : scene.traces)
    if (same_stamp(trace.stamp, stamp) && trace.trace_file == trace_file) return trace;
  scene.traces.push_back({.stamp = stamp, .label = stamp.label(), .trace_file = trace_file});
  return scene.traces.back();
}

template <typename Text>
void add_once(std::vector<Text>& list, const Text& text) {
  if (!text.empty() && std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

bool says_the_same(const core::Verdict& a, const core::Verdict& b) {
  return a.validator == b.validator && a.outcome == b.outcome && a.baseline == b.baseline &&
         a.worst.step == b.worst.step && a.worst.bodies == b.worst.bodies && a.checked == b.checked &&
         a.violations == b.violations && a.explanation == b.explanation;
}

void add_verdicts(SceneView& scene, TraceView& trace, const core::CellVerdicts& judged) {
  trace.is_simulation = trace.is_simulation || judged.is_simulation;
  trace.declaration.insert(judged.declaration.begin(), judged.declaration.end());
  for (const core::Verdict& verdict : judged.verdicts) {
    add_once(scene.validators, verdict.validator);
    add_once(trace.baselines, verdict.baseline);
    const auto column = static_cast<std::size_t>(
        std::find(scene.validators.begin(), scene.validators.end(), verdict.validator) - scene.validators.begin());
    if (trace.verdicts.size() <= column) trace.verdicts.resize(column + 1);
    std::vector<const core::Verdict*>& said = trace.verdicts[column];
    if (std::none_of(said.begin(), said.end(), [&](const core::Verdict* v) { return says_the_same(*v, verdict); }))
      said.push_back(&verdict);
  }
}

// Drops "not applicable" for lack of a baseline when there is also a verdict with a baseline.
void settle(TraceView& trace, std::size_t columns) {
  trace.verdicts.resize(columns);
  for (std::vector<const core::Verdict*>& said : trace.verdicts) {
    std::stable_sort(said.begin(), said.end(), [](const core::Verdict* a, const core::Verdict* b) {
      return severity(a->outcome) > severity(b->outcome);
    });
    if (!said.empty() && said.front()->outcome != core::Outcome::kNotApplicable)
      std::erase_if(said, [](const core::Verdict* v) { return v->outcome == core::Outcome::kNotApplicable; });
  }
}

void tell_labels_apart(SceneView& scene) {
  std::multiset<std::string> labels;
  for (const TraceView& trace : scene.traces) labels.insert(trace.label);
  for (TraceView& trace : scene.traces)
    if (labels.count(trace.label) > 1 && !trace.trace_file.empty()) trace.label += " (" + trace.trace_file + ")";
}

std::map<std::string, std::string> shared_notes(const SceneView& scene) {
  std::map<std::string, std::string> shared;
  bool is_first = true;
  for (const TraceView& trace : scene.traces) {
    if (trace.cell == nullptr || trace.cell->notes.empty()) continue;
    if (is_first) {
      shared = trace.cell->notes;
      is_first = false;
    }
    std::erase_if(shared, [&](const auto& note) {
      const auto found = trace.cell->notes.find(note.first);
      return found == trace.cell->notes.end() || found->second != note.second;
    });
  }
  return shared;
}

}  // namespace

bool TraceView::is_judged() const {
  return std::any_of(verdicts.begin(), verdicts.end(), [](const auto& said) { return !said.empty(); });
}

core::Coverage TraceView::coverage() const {
  std::vector<const core::Verdict*> all;
  for (const auto& said : verdicts) all.insert(all.end(), said.begin(), said.end());
  return core::coverage_of(all);
}

bool TraceView::has_proven_motion() const {
  return std::any_of(verdicts.begin(), verdicts.end(), [](const auto& said) {
    return std::any_of(said.begin(), said.end(), [](const core::Verdict* v) { return core::proves_motion(*v); });
  });
}

std::vector<std::pair<std::string, std::vector<std::string>>> TraceView::not_applied() const {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const auto& said : verdicts) {
    if (said.empty() || said.front()->outcome != core::Outcome::kNotApplicable) continue;
    const std::string& why = said.front()->explanation;
    auto found = std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == why; });
    if (found == reasons.end()) found = reasons.insert(found, {why, {}});
    found->second.push_back(said.front()->validator);
  }
  return reasons;
}

std::string TraceView::absence() const {
  if (cell == nullptr) return "not recorded";
  return cell->state == core::CellState::kRecorded ? "recorded, not judged" : state_text(*cell);
}

std::string stand_in(const SceneView& scene) {
  std::vector<std::string> said;
  for (const TraceView& trace : scene.traces) {
    if (trace.cell == nullptr) continue;
    for (const auto& [key, text] : trace.cell->notes) {
      if (key == "stand-in") {
        add_once(said, text);
      } else if (text.find("STAND-IN") != std::string::npos) {
        add_once(said, key + ": " + text);
      }
    }
  }
  std::string all;
  for (const std::string& text : said) all += (all.empty() ? "" : "; ") + text;
  return all;
}

std::vector<SceneView> by_scene(const core::RunRows& rows) {
  std::vector<SceneView> scenes;
  for (const core::Cell& cell : rows.cells)
    trace_of(scene_of(scenes, cell.stamp), cell.stamp, cell.trace_file).cell = &cell;
  for (const core::CellVerdicts& judged : rows.verdicts) {
    SceneView& scene = scene_of(scenes, judged.stamp);
    add_verdicts(scene, trace_of(scene, judged.stamp, judged.trace_file), judged);
  }
  for (const Timing& timing : pool_samples(rows)) scene_of(scenes, timing.stamp).timings.push_back(timing);
  for (SceneView& scene : scenes) {
    for (TraceView& trace : scene.traces) settle(trace, scene.validators.size());
    tell_labels_apart(scene);
    scene.facts = shared_notes(scene);
  }
  return scenes;
}

Tally tally(const std::vector<SceneView>& scenes) {
  Tally t;
  for (const SceneView& scene : scenes) {
    for (const TraceView& trace : scene.traces) {
      if (trace.cell != nullptr) ++(trace.cell->state == core::CellState::kRecorded ? t.recorded : t.absent);
      for (const auto& said : trace.verdicts) {
        for (const core::Verdict* verdict : said) {
          switch (verdict->outcome) {
            case core::Outcome::kPass:
              ++t.passed;
              break;
            case core::Outcome::kFail:
              ++t.failed;
              break;
            case core::Outcome::kInconclusive:
              ++t.inconclusive;
              break;
            case core::Outcome::kNotApplicable:
              ++t.not_applicable;
              break;
          }
        }
      }
    }
    for (const Timing& timing : scene.timings) ++(timing.admission.is_admitted ? t.admitted : t.struck_out);
  }
  return t;
}

core::Outcome overall(const Tally& tally) {
  if (tally.failed > 0) return core::Outcome::kFail;
  if (tally.inconclusive > 0) return core::Outcome::kInconclusive;
  return tally.passed > 0 ? core::Outcome::kPass : core::Outcome::kNotApplicable;
}

}  // namespace broadside::reports
