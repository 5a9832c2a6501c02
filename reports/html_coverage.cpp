// How much was judged: how many laws of each kind applied, whether a motion was proven, and why other laws did not
// apply.
#include <string>
#include <vector>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"

namespace broadside::reports {
namespace {

std::string_view column_of(core::LawKind kind) {
  switch (kind) {
    case core::LawKind::kMechanics:
      return "laws of mechanics";
    case core::LawKind::kMethod:
      return "of the method";
    case core::LawKind::kTrace:
      return "of the trace";
  }
  return "";
}

std::string motion_html(const TraceView& trace) {
  if (!trace.is_simulation) return absent_value("moves no bodies");
  return trace.has_proven_motion() ? "proven" : element("strong.reason", "its motion was not proven");
}

std::string reasons_html(const TraceView& trace) {
  std::size_t count = 0;
  std::string items;
  for (const auto& [why, laws] : trace.not_applied()) {
    count += laws.size();
    std::string names;
    for (std::size_t k = 0; k < laws.size(); ++k) names += (k == 0 ? "" : ", ") + html(laws[k]);
    items += element("li", element("b", names), ": ", html(why));
  }
  if (count == 0) return "every law applied";
  return element("details", element("summary", counted(count, "law"), " did not apply"), element("ul", items));
}

std::string count_html(const core::LawCount& count) {
  if (count.laws == 0) return absent_value("none asked for");
  return counted(count.applied) + " of " + counted(count.laws);
}

}  // namespace

std::string coverage_section(const SceneView& scene, PageParts&) {
  std::string rows;
  for (const TraceView& trace : scene.traces) {
    if (!trace.is_judged()) continue;
    const core::Coverage coverage = trace.coverage();
    std::string counts;
    for (const core::LawKind kind : core::kLawKinds)
      counts += figure_cell(column_of(kind), count_html(coverage.of(kind)));
    rows += element("tr", row_head(label_html(trace.stamp, trace.label)), counts,
                    text_cell("motion", motion_html(trace)), text_cell("did not apply", reasons_html(trace)));
  }
  if (rows.empty()) return "";
  std::vector<Column> columns{{"engine"}};
  for (const core::LawKind kind : core::kLawKinds) columns.push_back({std::string(column_of(kind)), true});
  columns.push_back({"motion"});
  columns.push_back({"did not apply"});
  return element("section", element("h3", "How much was judged"),
                 element("p.hint",
                         "How many of the laws that were asked for applied, which means that they found "
                         "something to check in the trace."),
                 element("table.coverage", table_head(columns), element("tbody", rows)));
}

}  // namespace broadside::reports
