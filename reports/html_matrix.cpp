// The verdict matrix and the list of findings.
#include <algorithm>

#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

std::string fact(std::string_view name, const std::string& value) {
  if (value.empty()) return "";
  return "<div><dt>" + std::string(name) + "</dt><dd>" + html(value) + "</dd></div>";
}

// The laws that a verdict sums up, each with its own worst place and counts.
std::string parts_html(const core::Verdict& verdict) {
  if (verdict.parts.empty()) return "";
  std::string out = "<ul class=\"parts\">";
  for (const core::Verdict& part : verdict.parts) {
    out += "<li>" + outcome_html(part.outcome, true) + " <b>" + html(part.validator) + "</b> ";
    if (part.outcome == core::Outcome::kFail) {
      const Compared values = compared(part.measured, part.limit, part.unit);
      out += counted(part.violations) + " of " + counted(part.checked) + ", worst at " + html(place_text(part.worst)) +
             ": " + html(values.measured) + " where " + html(values.limit) + " is allowed";
    } else {
      out += part.checked > 0 ? "all " + counted(part.checked) : html(part.explanation);
    }
    out += "</li>";
  }
  return out + "</ul>";
}

// Everything known about one verdict.
std::string verdict_card(const core::Verdict& verdict, const TraceView& trace, const PageParts& page) {
  const std::string& label = trace.label;
  std::string out = "<section class=\"verdict\"><h4>" + outcome_html(verdict.outcome, false) + " <span>" +
                    html(verdict.validator) + "</span></h4><p class=\"on\">on " + html(label);
  if (!verdict.baseline.empty()) out += ", against " + html(verdict.baseline);
  out += "</p>";
  if (!verdict.explanation.empty()) out += "<p>" + html(verdict.explanation) + "</p>";
  if (verdict.outcome != core::Outcome::kNotApplicable) {
    const Compared values = compared(verdict.measured, verdict.limit, verdict.unit);
    out += "<dl>" + fact("measured", values.measured) + fact("limit", values.limit) + fact("origin", verdict.origin) +
           fact("worst at", place_text(verdict.worst)) + fact("checked", counted(verdict.checked)) +
           fact("violations", counted(verdict.violations)) + "</dl>" + parts_html(verdict) +
           to_view_button(page, trace.stamp, trace.trace_file, verdict);
  }
  return out + "</section>";
}

std::string matrix_place(const SceneView& scene, const TraceView& trace, std::size_t column, bool is_leftward,
                         const PageParts& page) {
  const auto scene_number = static_cast<std::size_t>(&scene - page.scenes.data());
  const auto& said = trace.verdicts[column];
  const std::string name = html(scene.validators[column]);
  if (said.empty()) return "<td class=\"none\" data-name=\"" + name + "\"><span class=\"void\">not judged</span></td>";
  const core::Outcome outcome = said.front()->outcome;
  std::string out = "<td class=\"" + std::string(outcome_class(outcome)) + "\" data-name=\"" + name + "\">";
  // All share one name: opening one closes the one that was open, with scripts off too.
  out += "<details name=\"matrix-" + std::to_string(scene_number) + "\"><summary>" + outcome_html(outcome, true) +
         "<span class=\"unseen\"> <b>" + name + "</b> on " + html(trace.label) + "</span>";
  if (said.size() > 1) out += "<span class=\"unseen\">,</span> <i>\xC3\x97" + std::to_string(said.size()) + "</i>";
  out += "</summary><div class=\"card";
  if (is_leftward) out += " leftward";
  out += "\">";
  for (const core::Verdict* verdict : said) out += verdict_card(*verdict, trace, page);
  return out + "</div></details></td>";
}

std::string baselines_text(const TraceView& trace) {
  std::string text;
  for (std::size_t k = 0; k < trace.baselines.size(); ++k) text += (k == 0 ? "against " : ", ") + trace.baselines[k];
  return text;
}

// The baseline of every judged line when it is the same for all; then it is printed once.
std::string shared_baselines(const SceneView& scene) {
  std::string shared;
  std::size_t judged = 0;
  for (const TraceView& trace : scene.traces) {
    if (!trace.is_judged()) continue;
    if (judged++ == 0) shared = baselines_text(trace);
    if (baselines_text(trace) != shared) return "";
  }
  return judged > 1 ? shared : "";
}

std::string row_head(const TraceView& trace, bool says_baselines) {
  std::string out = "<th scope=\"row\">" + label_html(trace.stamp, trace.label);
  std::string below = says_baselines ? baselines_text(trace) : "";
  const bool is_partial = trace.cell != nullptr && trace.cell->state != core::CellState::kRecorded && trace.is_judged();
  if (is_partial) below += (below.empty() ? "" : "; ") + state_text(*trace.cell);
  if (!below.empty()) out += "<small>" + html(below) + "</small>";
  return out + "</th>";
}

// The laws that stand in one table.
struct Columns {
  core::LawKind kind = core::LawKind::kTrace;
  std::vector<std::size_t> validators;
};

core::LawKind kind_of(const SceneView& scene, std::size_t validator) {
  for (const TraceView& trace : scene.traces)
    if (validator < trace.verdicts.size() && !trace.verdicts[validator].empty())
      return trace.verdicts[validator].front()->kind;
  return core::LawKind::kTrace;
}

// One table, or of many laws one for each kind, so that a wide screen holds them.
std::vector<Columns> tables_of(const SceneView& scene) {
  constexpr std::size_t kManyColumns = 15;
  std::vector<Columns> tables;
  for (const core::LawKind kind : core::kLawKinds) {
    Columns columns{kind, {}};
    for (std::size_t c = 0; c < scene.validators.size(); ++c)
      if (scene.validators.size() <= kManyColumns || kind_of(scene, c) == kind) columns.validators.push_back(c);
    if (!columns.validators.empty()) tables.push_back(std::move(columns));
    if (scene.validators.size() <= kManyColumns) break;
  }
  return tables;
}

std::string_view heading_of(core::LawKind kind) {
  switch (kind) {
    case core::LawKind::kMechanics:
      return "Laws of mechanics";
    case core::LawKind::kMethod:
      return "Laws of the published method";
    case core::LawKind::kTrace:
      return "Laws of the trace";
  }
  return "";
}

std::string matrix_table(const SceneView& scene, const std::vector<std::size_t>& columns, bool says_baselines,
                         const PageParts& page) {
  // With more columns, two-line names no longer fit side by side on a wide screen.
  constexpr std::size_t kManyColumns = 12;
  std::string out = "<table class=\"matrix";
  if (columns.size() > kManyColumns) out += " many";
  out += "\"><thead><tr><th scope=\"col\">engine</th>";
  for (const std::size_t c : columns) out += "<th scope=\"col\"><span>" + html(scene.validators[c]) + "</span></th>";
  out += "</tr></thead><tbody>";
  for (const TraceView& trace : scene.traces) {
    out += "<tr>" + row_head(trace, says_baselines);
    if (!trace.is_judged()) {
      out +=
          "<td class=\"absent\" colspan=\"" + std::to_string(columns.size()) + "\">" + html(trace.absence()) + "</td>";
    } else {
      for (std::size_t k = 0; k < columns.size(); ++k)
        out += matrix_place(scene, trace, columns[k], k * 2 >= columns.size(), page);
    }
    out += "</tr>";
  }
  return out + "</tbody></table>";
}

struct Finding {
  const SceneView* scene;
  const TraceView* trace;
  const core::Verdict* verdict;
};

}  // namespace

std::string label_html(const core::Stamp& stamp, std::string_view label) {
  if (!label.starts_with(stamp.engine)) return "<span class=\"engine\">" + html(label) + "</span>";
  std::string out = "<span class=\"engine\">" + html(stamp.engine) + "</span>";
  std::string_view rest = label.substr(stamp.engine.size());
  // In plain text the label's brackets mark settings; here a lighter weight does.
  std::string shown(rest);
  if (const std::string bracketed = "[" + stamp.settings_short + "]"; rest.starts_with(bracketed))
    shown = stamp.settings_short + std::string(rest.substr(bracketed.size()));
  if (!shown.empty()) out += " <span class=\"settings\">" + html(shown) + "</span>";
  return out;
}

std::string_view outcome_class(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kPass:
      return "pass";
    case core::Outcome::kFail:
      return "fail";
    case core::Outcome::kInconclusive:
      return "open";
    case core::Outcome::kNotApplicable:
      return "none";
  }
  return "none";
}

std::string outcome_html(core::Outcome outcome, bool is_short) {
  std::string_view word = core::outcome_word(outcome);
  if (is_short && outcome == core::Outcome::kInconclusive) word = "unsure";
  if (is_short && outcome == core::Outcome::kNotApplicable) word = "n/a";
  return "<span class=\"word " + std::string(outcome_class(outcome)) + "\"><span aria-hidden=\"true\">" +
         std::string(symbol(outcome)) + "</span> " + std::string(word) + "</span>";
}

std::string matrix_section(const SceneView& scene, PageParts& page) {
  if (scene.validators.empty()) {
    std::string out = "<section><h3>Verdicts</h3><p>Nothing was judged.</p>";
    if (!scene.traces.empty()) {
      out += "<ul class=\"plain\">";
      for (const TraceView& trace : scene.traces)
        out += "<li>" + label_html(trace.stamp, trace.label) + ": " + html(trace.absence()) + "</li>";
      out += "</ul>";
    }
    return out + "</section>";
  }
  std::string out =
      "<section><h3>Verdicts</h3><p class=\"hint\">Each word opens what was measured, the limit and where it "
      "comes from, and the worst place.";
  const std::string shared = shared_baselines(scene);
  if (!shared.empty()) out += " All were judged " + html(shared) + ".";
  out += "</p>";
  const std::vector<Columns> tables = tables_of(scene);
  for (const Columns& columns : tables)
    out += (tables.size() > 1 ? "<h4>" + std::string(heading_of(columns.kind)) + "</h4>" : std::string()) +
           matrix_table(scene, columns.validators, shared.empty(), page);
  return out + "</section>";
}

std::string findings_section(PageParts& page) {
  const std::vector<SceneView>& scenes = page.scenes;
  std::vector<Finding> found;
  for (const SceneView& scene : scenes)
    for (const TraceView& trace : scene.traces)
      for (const auto& said : trace.verdicts)
        for (const core::Verdict* verdict : said)
          if (severity(verdict->outcome) >= severity(core::Outcome::kInconclusive))
            found.push_back({&scene, &trace, verdict});
  if (found.empty()) return "";
  std::stable_sort(found.begin(), found.end(), [](const Finding& a, const Finding& b) {
    return severity(a.verdict->outcome) > severity(b.verdict->outcome);
  });
  std::string out =
      "<section id=\"findings\"><h2>What did not pass</h2><table class=\"findings\"><thead><tr>"
      "<th scope=\"col\">verdict</th><th scope=\"col\">engine</th><th scope=\"col\" class=\"figure\">measured"
      "</th><th scope=\"col\" class=\"figure\">limit</th><th scope=\"col\">worst at</th><th scope=\"col\" "
      "class=\"figure\">violations</th></tr></thead><tbody>";
  for (const Finding& finding : found) {
    const core::Verdict& verdict = *finding.verdict;
    const Compared values = compared(verdict.measured, verdict.limit, verdict.unit);
    out += "<tr><td data-name=\"verdict\">" + outcome_html(verdict.outcome, true) + " <strong>" +
           html(verdict.validator) + "</strong></td><td data-name=\"engine\">" +
           label_html(finding.trace->stamp, finding.trace->label);
    if (scenes.size() > 1) out += "<small>" + html(finding.scene->name) + "</small>";
    if (!verdict.baseline.empty()) out += "<small>against " + html(verdict.baseline) + "</small>";
    out += "</td><td class=\"figure\" data-name=\"measured\">" + html(values.measured) +
           "</td><td class=\"figure\" data-name=\"limit\">" + html(values.limit) + "</td><td data-name=\"worst at\">" +
           html(place_text(verdict.worst)) + "</td><td class=\"figure\" data-name=\"violations\">" +
           counted(verdict.violations) + "<small>of " + counted(verdict.checked) + "</small></td></tr>";
    out += "<tr class=\"why\"><td colspan=\"6\">" + html(verdict.explanation);
    if (!verdict.origin.empty()) out += " <span class=\"origin\">Limit: " + html(verdict.origin) + "</span>";
    out += parts_html(verdict) + to_view_button(page, finding.trace->stamp, finding.trace->trace_file, verdict) +
           "</td></tr>";
  }
  return out + "</tbody></table></section>";
}

}  // namespace broadside::reports
