// What ran, on what, and how to run it again.
#include <algorithm>
#include <set>

#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

constexpr std::string_view kPairs = "pairs: ";
constexpr std::string_view kCommand = "command";
// For a process that died: the command that makes it die again.
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
  std::string out = std::string("<tr") + (is_recorded ? "" : " class=\"absent\"") + "><th scope=\"row\">" +
                    label_html(trace.stamp, trace.label) + "</th><td data-name=\"state\">" + html(state_text(cell)) +
                    "</td>";
  out += "<td class=\"figure\" data-name=\"frames\">" + (has_run ? counted(cell.frames) : "none") + "</td>";
  out += "<td class=\"figure\" data-name=\"recorded in\">" + (has_run ? html(quantity(cell.wall_s, "s")) : "none") +
         "</td>";
  for (const std::string& key : pairs) {
    const auto found = cell.notes.find(key);
    out += "<td class=\"figure\" data-name=\"" + html(key) + "\">" +
           (found == cell.notes.end() ? "<span class=\"void\">none</span>" : html(found->second)) + "</td>";
  }
  std::string remarks;
  for (const auto& [key, text] : cell.notes)
    if (!has_own_place(key) && !scene.facts.contains(key)) remarks += (remarks.empty() ? "" : "; ") + key + ": " + text;
  out += "<td data-name=\"trace\">" +
         (cell.trace_file.empty() ? "<span class=\"void\">none</span>" : "<code>" + html(cell.trace_file) + "</code>");
  if (!remarks.empty()) out += "<small>" + html(remarks) + "</small>";
  return out + "</td></tr>";
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
    out += "<div><dt>" + std::string(name);
    if (values.size() > 1) {
      out += "<small>";
      for (std::size_t k = 0; k < engines.size(); ++k) out += (k == 0 ? "" : ", ") + html(engines[k]);
      out += "</small>";
    }
    out += "</dt><dd>" + (value.empty() ? "<span class=\"void\">not stated</span>" : html(value)) + "</dd></div>";
  }
  return out;
}

std::string command_item(const std::string& command) {
  return "<li><pre><code>" + html(command) + "</code></pre></li>";
}

}  // namespace

std::string cells_section(const SceneView& scene, PageParts&) {
  const std::vector<std::string> pairs = pair_columns(scene);
  std::string rows;
  for (const TraceView& trace : scene.traces)
    if (trace.cell != nullptr) rows += cell_row(scene, trace, pairs);
  if (rows.empty()) return "";
  std::string out =
      "<section><h3>What ran</h3><table class=\"cells\"><thead><tr><th scope=\"col\">engine</th><th "
      "scope=\"col\">state</th><th scope=\"col\" class=\"figure\">frames</th><th scope=\"col\" "
      "class=\"figure\">recorded in</th>";
  for (const std::string& key : pairs)
    out += "<th scope=\"col\" class=\"figure\">" + html(key.substr(kPairs.size())) + "<small>pairs</small></th>";
  out += "<th scope=\"col\">trace</th></tr></thead><tbody>" + rows +
         "</tbody></table><p class=\"hint\">Recording writes every "
         "frame to disk; its duration is no benchmark.</p></section>";
  return out;
}

std::string facts_section(const SceneView& scene, PageParts&) {
  std::string out = "<section><div class=\"facts\"><div><h3>Scene</h3><dl><div><dt>name</dt><dd>" + html(scene.name) +
                    "</dd></div><div><dt>digest</dt><dd><code>" + hexadecimal(scene.digest) + "</code></dd></div>";
  for (const auto& [key, text] : scene.facts)
    if (!has_own_place(key)) out += "<div><dt>" + html(key) + "</dt><dd>" + html(text) + "</dd></div>";
  out += "</dl></div><div><h3>Machine and build</h3><dl>" + stamp_fact(scene, "machine", &core::Stamp::machine) +
         stamp_fact(scene, "Broadside", &core::Stamp::broadside_build) +
         stamp_fact(scene, "engine", &core::Stamp::engine_build) + "</dl></div></div></section>";
  return out;
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
  std::string out = "<section id=\"repeat\"><h2>How to repeat</h2><ol class=\"commands\">";
  for (const std::string& command : commands) out += command_item(command);
  return out + "</ol></section>";
}

std::string legend_section(PageParts&) {
  using core::Outcome;
  return "<section class=\"legend\" id=\"legend\"><h2>How to read this page</h2><dl>"
         "<div><dt>" +
         outcome_html(Outcome::kPass, true) +
         "</dt><dd>the law held in everything that was checked</dd></div>"
         "<div><dt>" +
         outcome_html(Outcome::kFail, true) +
         "</dt><dd>the measured value is beyond its limit somewhere; the "
         "worst place is named</dd></div>"
         "<div><dt>" +
         outcome_html(Outcome::kInconclusive, true) +
         "</dt><dd>inconclusive: the trace can neither prove nor "
         "refute it</dd></div>"
         "<div><dt>" +
         outcome_html(Outcome::kNotApplicable, true) +
         "</dt><dd>not applicable to this engine or trace; the "
         "place says why</dd></div>"
         "<div><dt>\xC3\x97"
         "2</dt><dd>so many verdicts: alone and against baselines; the gravest is shown, the place lists all</dd></div>"
         "<div><dt>struck out</dt><dd>A time counts only when a recording of the same scene, engine, settings, build "
         "and "
         "machine exists, at least one verdict on it passed and none failed, a law tied a motion of the engine to "
         "forces, "
         "and the timed run ended in the recorded state, "
         "bit by bit.</dd></div>"
         "<div><dt>spread</dt><dd>distance of the quartiles over the median, over all timed frames</dd></div>"
         "<div><dt>FPS</dt><dd>frames over their total time, per run; mean and standard deviation over runs</dd></div>"
         "</dl></section>";
}

}  // namespace broadside::reports
