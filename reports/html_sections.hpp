// The parts of the HTML page. Every function returns escaped HTML; ids are numbers, never names.
#pragma once

#include <string>
#include <string_view>

#include "reports/report.hpp"
#include "reports/scene_view.hpp"

namespace broadside::reports {

// Failed and inconclusive verdicts of all scenes, gravest first; empty when there are none.
std::string findings_section(const std::vector<SceneView>& scenes);
// Engines down, validators across; each place opens its verdicts. scene_number makes ids differ.
std::string matrix_section(const SceneView& scene, std::size_t scene_number);
// Bars and tables of times; says so when nothing was timed.
std::string times_section(const SceneView& scene);
// What ran and what did not, with pair counts; facts of scene, machine and build.
std::string cells_section(const SceneView& scene);
std::string facts_section(const SceneView& scene);
// Two plots for each run whose ledger is there; empty without any.
std::string energy_section(const std::vector<core::EnergySeries>& all);
// Commands to copy.
std::string repeat_section(const std::vector<SceneView>& scenes, const ReportOptions& options);
// What the words and figures mean.
std::string legend_section();

// "octree-cpu" and its settings, told apart by weight.
std::string label_html(const core::Stamp& stamp, std::string_view label);
// The symbol and the word of an outcome; `is_short` where a column is narrow.
std::string outcome_html(core::Outcome outcome, bool is_short);
// "pass", "fail", "open", "none": the style of an outcome.
std::string_view outcome_class(core::Outcome outcome);

}  // namespace broadside::reports
