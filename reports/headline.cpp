// The one sentence that opens every report; declared in scene_view.hpp.
#include <algorithm>

#include "reports/figures.hpp"
#include "reports/scene_view.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

struct Finding {
  std::string label;
  const core::Verdict* verdict = nullptr;
};

std::vector<Finding> findings(const std::vector<SceneView>& scenes, core::Outcome outcome) {
  std::vector<Finding> found;
  for (const SceneView& scene : scenes)
    for (const TraceView& trace : scene.traces)
      for (const auto& said : trace.verdicts)
        for (const core::Verdict* verdict : said)
          if (verdict->outcome == outcome) found.push_back({trace.label, verdict});
  return found;
}

// "on 2 of 9 traces": on how many traces these verdicts were found.
std::string reach(const std::vector<SceneView>& scenes, const std::vector<Finding>& found) {
  std::vector<std::string> labels;
  for (const Finding& finding : found)
    if (std::find(labels.begin(), labels.end(), finding.label) == labels.end()) labels.push_back(finding.label);
  std::uint64_t judged = 0;
  for (const SceneView& scene : scenes)
    judged += static_cast<std::uint64_t>(
        std::count_if(scene.traces.begin(), scene.traces.end(), [](const TraceView& t) { return t.is_judged(); }));
  if (labels.size() == 1) return "on " + labels[0];
  return "on " + std::to_string(labels.size()) + " of " + counted(judged, "trace");
}

// The names of the validators, the first with its worst place: "center-of-mass (worst at step 41, bodies 3 and 17),
// capacity".
std::string named(const std::vector<Finding>& found, bool name_the_trace) {
  constexpr std::size_t kNamed = 3;
  const core::Verdict& first = *found.front().verdict;
  std::string text = first.validator;
  if (name_the_trace) text += " on " + found.front().label;
  if (first.worst.step >= 0 || !first.worst.bodies.empty()) {
    core::Place place = first.worst;
    place.field.clear();
    text += " (worst at " + place_text(place) + ")";
  }
  std::vector<std::string> names{first.validator};
  for (const Finding& finding : found)
    if (std::find(names.begin(), names.end(), finding.verdict->validator) == names.end())
      names.push_back(finding.verdict->validator);
  for (std::size_t k = 1; k < std::min(kNamed, names.size()); ++k) text += ", " + names[k];
  if (names.size() > kNamed) text += " and " + counted(names.size() - kNamed, "other validator");
  return text;
}

std::string absent_part(const Tally& t) {
  if (t.absent == 0) return "";
  return "; " + counted(t.absent, "cell") + (t.absent == 1 ? " was" : " were") + " not measured";
}

}  // namespace

std::string headline(const std::vector<SceneView>& scenes) {
  const Tally t = tally(scenes);
  const std::string all = counted(t.judged(), "verdict");
  if (t.failed > 0) {
    const std::vector<Finding> found = findings(scenes, core::Outcome::kFail);
    const std::string where = reach(scenes, found);
    const bool is_one = where.starts_with("on ") && where.find(" of ") == std::string::npos;
    return counted(t.failed) + " of " + all + " failed " + where + ": " + named(found, !is_one) + absent_part(t) + ".";
  }
  if (t.inconclusive > 0) {
    const std::vector<Finding> found = findings(scenes, core::Outcome::kInconclusive);
    return "Nothing failed, but " + counted(t.inconclusive) + " of " + all + (t.inconclusive == 1 ? " is" : " are") +
           " inconclusive " + reach(scenes, found) + absent_part(t) + ".";
  }
  if (t.passed > 0) {
    std::uint64_t judged = 0;
    for (const SceneView& scene : scenes)
      for (const TraceView& trace : scene.traces) judged += trace.is_judged() ? 1U : 0U;
    return (t.passed == 1 ? "The one verdict" : "All " + counted(t.passed) + " verdicts") + " passed on " +
           counted(judged, "trace") + absent_part(t) + ".";
  }
  if (t.not_applicable > 0) return "No validator applied, so nothing was proven" + absent_part(t) + ".";
  return "Nothing was judged" + absent_part(t) + ".";
}

}  // namespace broadside::reports
