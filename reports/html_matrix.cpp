// The verdict matrix and the list of findings.
#include <algorithm>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

std::string fact(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fact_entry(name, html(value));
}

// The laws that a verdict sums up, each with its own worst place and counts.
std::string parts_html(const core::Verdict& verdict) {
  if (verdict.parts.empty()) return "";
  std::string items;
  for (const core::Verdict& part : verdict.parts) {
    const Compared values = compared(part.measured, part.limit, part.unit);
    const std::string said = part.outcome == core::Outcome::kFail
                                 ? counted(part.violations) + " of " + counted(part.checked) + ", worst at " +
                                       html(place_text(part.worst)) + ": " + html(values.measured) + " where " +
                                       html(values.limit) + " is allowed"
                             : part.checked > 0 ? "all " + counted(part.checked)
                                                : html(part.explanation);
    items += element("li", outcome_html(part.outcome, true), " ", element("b", html(part.validator)), " ", said);
  }
  return element("ul.parts", items);
}

// The card with everything that is known about one verdict.
std::string verdict_card(const core::Verdict& verdict, const TraceView& trace, const PageParts& page) {
  std::string out = element("h4", outcome_html(verdict.outcome, false), " ", element("span", html(verdict.validator)));
  const std::string against = verdict.baseline.empty() ? "" : ", against " + html(verdict.baseline);
  out += element("p.on", "on ", html(trace.label), against);
  if (!verdict.explanation.empty()) out += element("p", html(verdict.explanation));
  if (verdict.outcome != core::Outcome::kNotApplicable) {
    const Compared values = compared(verdict.measured, verdict.limit, verdict.unit);
    out += element("dl", fact("measured", values.measured), fact("limit", values.limit), fact("origin", verdict.origin),
                   fact("worst at", place_text(verdict.worst)), fact("checked", counted(verdict.checked)),
                   fact("violations", counted(verdict.violations)));
    out += parts_html(verdict) + to_view_button(page, trace.stamp, trace.trace_file, verdict);
  }
  return element("section.verdict", out);
}

std::string matrix_place(const SceneView& scene, const TraceView& trace, std::size_t column, bool is_leftward,
                         const PageParts& page) {
  const auto scene_number = static_cast<std::size_t>(&scene - page.scenes.data());
  const auto& said = trace.verdicts[column];
  const std::string& name = scene.validators[column];
  if (said.empty()) return element("td.none", {{"data-name", name}}, absent_value("not judged"));
  const core::Outcome outcome = said.front()->outcome;
  std::string summary =
      outcome_html(outcome, true) + element("span.unseen", " ", element("b", html(name)), " on ", html(trace.label));
  if (said.size() > 1)
    summary += element("span.unseen", ",") + " " + element("i", "\u00D7", std::to_string(said.size()));
  std::string cards;
  for (const core::Verdict* verdict : said) cards += verdict_card(*verdict, trace, page);
  // All cells share one name, so that opening one closes the other, even without scripts.
  return element("td." + std::string(outcome_class(outcome)), {{"data-name", name}},
                 element("details", {{"name", "matrix-" + std::to_string(scene_number)}}, element("summary", summary),
                         element(is_leftward ? "div.card.leftward" : "div.card", cards)));
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

std::string engine_head(const TraceView& trace, bool says_baselines) {
  std::string below = says_baselines ? baselines_text(trace) : "";
  const bool is_partial = trace.cell != nullptr && trace.cell->state != core::CellState::kRecorded && trace.is_judged();
  if (is_partial) below += (below.empty() ? "" : "; ") + state_text(*trace.cell);
  return row_head(label_html(trace.stamp, trace.label) + (below.empty() ? "" : element("small", html(below))));
}

// The columns of one table: laws of one kind, or all laws.
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

// One table; where there are many laws, one table for each kind, so that each fits a wide screen.
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

std::string_view matrix_heading(core::LawKind kind) {
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
  std::string rows;
  for (const TraceView& trace : scene.traces) {
    std::string places;
    for (std::size_t k = 0; trace.is_judged() && k < columns.size(); ++k)
      places += matrix_place(scene, trace, columns[k], k * 2 >= columns.size(), page);
    if (!trace.is_judged())
      places = element("td.absent", {{"colspan", std::to_string(columns.size())}}, html(trace.absence()));
    rows += element("tr", engine_head(trace, says_baselines), places);
  }
  // With more columns, two-line names no longer fit side by side on a wide screen.
  constexpr std::size_t kManyColumns = 12;
  std::string head = column_head({"engine"});
  for (const std::size_t c : columns)
    head += element("th", {{"scope", "col"}}, element("span", html(scene.validators[c])));
  return element(columns.size() > kManyColumns ? "table.matrix.many" : "table.matrix",
                 element("thead", element("tr", head)), element("tbody", rows));
}

struct UnmetCell {
  const SceneView* scene;
  const TraceView* trace;
  const core::Verdict* verdict;
};

}  // namespace

std::string label_html(const core::Stamp& stamp, std::string_view label) {
  if (!label.starts_with(stamp.engine)) return element("span.engine", html(label));
  std::string out = element("span.engine", html(stamp.engine));
  std::string_view rest = label.substr(stamp.engine.size());
  // In plain text the label's brackets mark settings; here a lighter weight does.
  std::string shown(rest);
  if (const std::string bracketed = "[" + stamp.settings_short + "]"; rest.starts_with(bracketed))
    shown = stamp.settings_short + std::string(rest.substr(bracketed.size()));
  if (!shown.empty()) out += " " + element("span.settings", html(shown));
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
  return element("span.word." + std::string(outcome_class(outcome)),
                 element("span", {{"aria-hidden", "true"}}, symbol(outcome)), " ", word);
}

std::string matrix_section(const SceneView& scene, PageParts& page) {
  if (scene.validators.empty()) {
    std::string absences;
    for (const TraceView& trace : scene.traces)
      absences += element("li", label_html(trace.stamp, trace.label), ": ", html(trace.absence()));
    return element("section", element("h3", "Verdicts"), element("p", "Nothing was judged."),
                   absences.empty() ? "" : element("ul.plain", absences));
  }
  const std::string shared = shared_baselines(scene);
  const std::vector<Columns> tables = tables_of(scene);
  std::string all;
  for (const Columns& columns : tables)
    all += (tables.size() > 1 ? element("h4", matrix_heading(columns.kind)) : std::string()) +
           matrix_table(scene, columns.validators, shared.empty(), page);
  return element("section", element("h3", "Verdicts"),
                 element("p.hint",
                         "Click a word to see what was measured, the limit and where it comes from, and the worst "
                         "place.",
                         shared.empty() ? "" : " All were judged " + html(shared) + "."),
                 all);
}

std::string findings_section(PageParts& page) {
  const std::vector<SceneView>& scenes = page.scenes;
  std::vector<UnmetCell> found;
  for (const SceneView& scene : scenes)
    for (const TraceView& trace : scene.traces)
      for (const auto& said : trace.verdicts)
        for (const core::Verdict* verdict : said)
          if (severity(verdict->outcome) >= severity(core::Outcome::kInconclusive))
            found.push_back({&scene, &trace, verdict});
  if (found.empty()) return "";
  std::stable_sort(found.begin(), found.end(), [](const UnmetCell& a, const UnmetCell& b) {
    return severity(a.verdict->outcome) > severity(b.verdict->outcome);
  });
  std::string rows;
  for (const UnmetCell& finding : found) {
    const core::Verdict& verdict = *finding.verdict;
    const Compared values = compared(verdict.measured, verdict.limit, verdict.unit);
    const std::string of_scene = scenes.size() > 1 ? element("small", html(finding.scene->name)) : "";
    const std::string against = verdict.baseline.empty() ? "" : element("small", "against ", html(verdict.baseline));
    const std::string label = label_html(finding.trace->stamp, finding.trace->label);
    const std::string origin =
        verdict.origin.empty() ? "" : " " + element("span.origin", "Limit: ", html(verdict.origin));
    rows += element(
        "tr",
        text_cell("verdict", outcome_html(verdict.outcome, true) + " " + element("strong", html(verdict.validator))),
        text_cell("engine", label + of_scene + against), figure_cell("measured", html(values.measured)),
        figure_cell("limit", html(values.limit)), text_cell("worst at", html(place_text(verdict.worst))),
        figure_cell("violations", counted(verdict.violations) + element("small", "of ", counted(verdict.checked))));
    rows += element("tr.why", element("td", {{"colspan", "6"}}, html(verdict.explanation), origin, parts_html(verdict),
                                      to_view_button(page, finding.trace->stamp, finding.trace->trace_file, verdict)));
  }
  return element(
      "section", {{"id", "findings"}}, element("h2", "What did not pass"),
      element("table.findings",
              table_head(
                  {{"verdict"}, {"engine"}, {"measured", true}, {"limit", true}, {"worst at"}, {"violations", true}}),
              element("tbody", rows)));
}

}  // namespace broadside::reports
