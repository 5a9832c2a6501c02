// Which times may be shown side by side.
#pragma once

#include <string>
#include <vector>

#include "reports/scene_view.hpp"

namespace broadside::reports {

// Engines that report the same stages did the same kind of work; only such engines share a scale.
struct TimingGroup {
  std::vector<std::string> stages;
  std::vector<const Timing*> timings;

  // "integrate, broad, levels"; "whole frames" without stages.
  [[nodiscard]] std::string work() const;
};

// In order of first appearance. Pointers are into the scene.
std::vector<TimingGroup> groups_of(const SceneView& scene);

}  // namespace broadside::reports
