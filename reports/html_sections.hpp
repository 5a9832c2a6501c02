// The parts of the HTML page. Every function returns escaped HTML; ids are numbers, never names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/chart.hpp"
#include "reports/report.hpp"
#include "reports/scene_view.hpp"

namespace broadside::reports {

// What every part can read, and the charts that it adds.
struct PageParts {
  const core::RunRows& rows;
  const ReportOptions& options;
  const std::vector<SceneView>& scenes;
  ChartBook charts = {};
};

// A part of the page about one scene, or about the whole run; empty when it has nothing to show. html_page.cpp has the
// two tables that list these parts in the order of the page: a new part is one file and one line.
using ScenePart = std::string (*)(const SceneView& scene, PageParts& page);
using RunPart = std::string (*)(PageParts& page);

// Failed and inconclusive verdicts of all scenes, gravest first.
std::string findings_section(PageParts& page);
// The 3-D view, with a picture for paper and for browsers without WebGL.
std::string view_section(PageParts& page);
// Parts that were made by other code, such as the paper's tables.
std::string guest_sections(PageParts& page);
// Cost against the number of bodies, over scenes of one family.
std::string scaling_section(PageParts& page);
// The energy ledger of each run that has one, as curves.
std::string energy_section(PageParts& page);
// Earlier runs of the same cells, with change points.
std::string history_section(PageParts& page);
// Commands to copy.
std::string repeat_section(PageParts& page);
// What each law says, with a picture.
std::string laws_section(PageParts& page);
// What the words and figures mean.
std::string legend_section(PageParts& page);

// Engines are rows, validators are columns; each cell opens its verdicts.
std::string matrix_section(const SceneView& scene, PageParts& page);
// How many laws applied, and why the others did not.
std::string coverage_section(const SceneView& scene, PageParts& page);
// Bars and tables of times; says so when nothing was timed.
std::string times_section(const SceneView& scene, PageParts& page);
// Frames per second and stages along the run.
std::string over_frames_section(const SceneView& scene, PageParts& page);
// Ratios of engines that did the same work, with intervals.
std::string side_by_side_section(const SceneView& scene, PageParts& page);
// Pairs by kind, and the precision of broad phases.
std::string counts_section(const SceneView& scene, PageParts& page);
// Figures along the steps that recording or judging left: penetration, energy.
std::string frame_series_section(const SceneView& scene, PageParts& page);
// How far narrow phases are from the exact answer.
std::string agreement_section(const SceneView& scene, PageParts& page);
// What ran and what did not, with pair counts; facts of scene, machine and build.
std::string cells_section(const SceneView& scene, PageParts& page);
std::string facts_section(const SceneView& scene, PageParts& page);

// "octree-cpu" and its settings, distinguished by weight.
std::string label_html(const core::Stamp& stamp, std::string_view label);
// The symbol and the word of an outcome; `is_short` where a column is narrow.
std::string outcome_html(core::Outcome outcome, bool is_short);
// "pass", "fail", "open", "none": the style of an outcome.
std::string_view outcome_class(core::Outcome outcome);
// The link from a verdict to its place in the 3-D view; empty when no playback shows it.
std::string to_view_button(const PageParts& page, const core::Stamp& stamp, const std::string& trace_file,
                           const core::Verdict& verdict);

}  // namespace broadside::reports
