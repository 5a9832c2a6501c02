// What ran, on which machine, and how to run it again.
#include <algorithm>
#include <set>

#include "reports/element.hpp"
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

constexpr std::string_view kPairs = "pairs: ";
constexpr std::string_view kCommand = "command";
// The note of a process that died: the command that repeats the failure.
constexpr std::string_view kRepeat = "repeat";
constexpr std::string_view kStandIn = "stand-in";

bool has_own_place(const std::string& key) {
  return is_equivalence_note(key) || key == kRepeat || key.starts_with(kPairs) || key == kCommand || key == kStandIn;
}

std::vector<std::string> pair_columns(const SceneView& scene) {
  std::set<std::string> keys;
  for (const TraceView& trace : scene.traces)
    if (trace.cell != nullptr)
      for (const auto& [key, text] : trace.cell->notes)
        if (key.starts_with(kPairs)) keys.insert(key);
  return {keys.begin(), keys.end()};
}

std::string cell_row(const SceneView& scene, const TraceView& trace, const std::vector<std::string>& pairs) {
  const core::Cell& cell = *trace.cell;
  const bool is_recorded = cell.state == core::CellState::kRecorded;
  const bool has_run = is_recorded || cell.frames > 0;
  std::string counts;
  for (const std::string& key : pairs) {
    const auto found = cell.notes.find(key);
    counts += figure_cell(key, found == cell.notes.end() ? absent_value("none") : html(found->second));
  }
  std::string remarks;
  for (const auto& [key, text] : cell.notes)
    if (!has_own_place(key) && !scene.facts.contains(key)) remarks += (remarks.empty() ? "" : "; ") + key + ": " + text;
  return element(is_recorded ? "tr" : "tr.absent", row_head(label_html(trace.stamp, trace.label)),
                 text_cell("state", html(state_text(cell))),
                 figure_cell("frames", has_run ? counted(cell.frames) : "none"),
                 figure_cell("recorded in", has_run ? html(quantity(cell.wall_s, "s")) : "none"), counts,
                 element("td", {{"data-name", "trace"}},
                         cell.trace_file.empty() ? absent_value("none") : element("code", html(cell.trace_file)),
                         remarks.empty() ? "" : element("small", html(remarks))));
}

// One entry when all traces agree, otherwise one per value with the engines that have it.
std::string stamp_fact(const SceneView& scene, std::string_view name, std::string core::Stamp::*field) {
  std::vector<std::pair<std::string, std::vector<std::string>>> values;
  for (const TraceView& trace : scene.traces) {
    const std::string& value = trace.stamp.*field;
    auto found = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == value; });
    if (found == values.end()) found = values.insert(found, {value, {}});
    if (std::find(found->second.begin(), found->second.end(), trace.stamp.engine) == found->second.end())
      found->second.push_back(trace.stamp.engine);
  }
  std::string out;
  for (const auto& [value, engines] : values) {
    std::string whose;
    for (const std::string& engine : engines) whose += (whose.empty() ? "" : ", ") + html(engine);
    out += fact_entry(std::string(name) + (values.size() > 1 ? element("small", whose) : ""),
                      value.empty() ? absent_value("not stated") : html(value));
  }
  return out;
}

std::string command_item(const std::string& command) {
  return element("li", element("pre", element("code", html(command))));
}

}  // namespace

std::string cells_section(const SceneView& scene, PageParts&) {
  const std::vector<std::string> pairs = pair_columns(scene);
  std::string rows;
  for (const TraceView& trace : scene.traces)
    if (trace.cell != nullptr) rows += cell_row(scene, trace, pairs);
  if (rows.empty()) return "";
  std::vector<Column> columns{{"engine"}, {"state"}, {"frames", true}, {"recorded in", true}};
  for (const std::string& key : pairs) columns.push_back({key.substr(kPairs.size()), true, "pairs"});
  columns.push_back({"trace"});
  return element("section", element("h3", "What ran"),
                 element("table.cells", table_head(columns), element("tbody", rows)),
                 element("p.hint", "Recording writes every frame to disk, so its duration is not a benchmark."));
}

std::string facts_section(const SceneView& scene, PageParts&) {
  std::string of_scene =
      fact_entry("name", html(scene.name)) + fact_entry("digest", element("code", hexadecimal(scene.digest)));
  for (const auto& [key, text] : scene.facts)
    if (!has_own_place(key)) of_scene += fact_entry(html(key), html(text));
  const std::string of_stamp = stamp_fact(scene, "machine", &core::Stamp::machine) +
                               stamp_fact(scene, "Broadside", &core::Stamp::broadside_build) +
                               stamp_fact(scene, "engine", &core::Stamp::engine_build);
  return element("section", element("div.facts", element("div", element("h3", "Scene"), element("dl", of_scene)),
                                    element("div", element("h3", "Machine and build"), element("dl", of_stamp))));
}

std::string repeat_section(PageParts& page) {
  const ReportOptions& options = page.options;
  std::vector<std::string> commands;
  const auto add = [&](const std::string& command) {
    if (!command.empty() && std::find(commands.begin(), commands.end(), command) == commands.end())
      commands.push_back(command);
  };
  add(options.command);
  for (const std::string& command : options.repeat) add(command);
  for (const SceneView& scene : page.scenes)
    for (const TraceView& trace : scene.traces)
      if (trace.cell != nullptr)
        for (const std::string_view key : {kCommand, kRepeat})
          if (const auto found = trace.cell->notes.find(std::string(key)); found != trace.cell->notes.end())
            add(found->second);
  if (commands.empty()) return "";
  std::string items;
  for (const std::string& command : commands) items += command_item(command);
  return element("section", {{"id", "repeat"}}, element("h2", "How to repeat"), element("ol.commands", items));
}

std::string legend_section(PageParts&) {
  using core::Outcome;
  const std::string entries =
      fact_entry(outcome_html(Outcome::kPass, true), "the law held in everything that was checked") +
      fact_entry(outcome_html(Outcome::kFail, true),
                 "the measured value is beyond its limit somewhere; the worst place is named") +
      fact_entry(outcome_html(Outcome::kInconclusive, true),
                 "inconclusive: the trace can neither prove nor refute it") +
      fact_entry(outcome_html(Outcome::kNotApplicable, true),
                 "not applicable to this engine or trace; the opened cell says why") +
      fact_entry("\u00D72",
                 "number of verdicts, alone and against baselines; the worst is shown, the opened cell lists all") +
      fact_entry("struck out",
                 "A time counts only when a recording of the same scene, engine, settings, build and machine "
                 "exists, at least one verdict on it passed and none failed, a law that proves motion passed on a "
                 "body that moved, and the timed run ended in the recorded state, bit by bit.") +
      fact_entry("spread", "interquartile range divided by the median, over all timed frames") +
      fact_entry("FPS", "frames divided by their total time, per run; mean and standard deviation over runs");
  return element("section.legend", {{"id", "legend"}}, element("h2", "How to read this page"), element("dl", entries));
}

}  // namespace broadside::reports
