#include "reports/timing_groups.hpp"

#include <algorithm>

namespace broadside::reports {

std::string TimingGroup::work() const {
  std::string text;
  for (const std::string& stage : stages) text += (text.empty() ? "" : ", ") + stage;
  return text.empty() ? "whole frames" : text;
}

std::vector<TimingGroup> groups_of(const SceneView& scene) {
  std::vector<TimingGroup> groups;
  for (const Timing& timing : scene.timings) {
    std::vector<std::string> names;
    for (const StageTiming& stage : timing.stages) names.push_back(stage.stage);
    auto found = std::find_if(groups.begin(), groups.end(), [&](const TimingGroup& g) { return g.stages == names; });
    if (found == groups.end()) found = groups.insert(found, {names, {}});
    found->timings.push_back(&timing);
  }
  return groups;
}

}  // namespace broadside::reports
