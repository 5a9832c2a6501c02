// How much was judged: laws that applied by kind, whether a motion was proven, and why the others did not apply.
#include <string>

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
  if (!trace.is_simulation) return "<span class=\"void\">moved nothing itself</span>";
  return trace.has_proven_motion() ? "proven" : "<strong class=\"reason\">nothing of its motion was proven</strong>";
}

std::string reasons_html(const TraceView& trace) {
  std::size_t count = 0;
  std::string items;
  for (const auto& [why, laws] : trace.not_applied()) {
    count += laws.size();
    items += "<li><b>";
    for (std::size_t k = 0; k < laws.size(); ++k) items += (k == 0 ? "" : ", ") + html(laws[k]);
    items += "</b>: " + html(why) + "</li>";
  }
  if (count == 0) return "every law applied";
  return "<details><summary>" + counted(count, "law") + " did not apply</summary><ul>" + items + "</ul></details>";
}

}  // namespace

std::string coverage_section(const SceneView& scene, PageParts&) {
  std::string rows;
  for (const TraceView& trace : scene.traces) {
    if (!trace.is_judged()) continue;
    const core::Coverage coverage = trace.coverage();
    rows += "<tr><th scope=\"row\">" + label_html(trace.stamp, trace.label) + "</th>";
    for (const core::LawKind kind : core::kLawKinds) {
      const core::LawCount& count = coverage.of(kind);
      rows += "<td class=\"figure\" data-name=\"" + std::string(column_of(kind)) + "\">" +
              (count.laws == 0 ? std::string("<span class=\"void\">none asked for</span>")
                               : counted(count.applied) + " of " + counted(count.laws)) +
              "</td>";
    }
    rows += "<td data-name=\"motion\">" + motion_html(trace) + "</td><td data-name=\"did not apply\">" +
            reasons_html(trace) + "</td></tr>";
  }
  if (rows.empty()) return "";
  std::string out =
      "<section><h3>How much was judged</h3><p class=\"hint\">Laws that met something in the trace, of those that were "
      "asked for.</p><table class=\"coverage\"><thead><tr><th scope=\"col\">engine</th>";
  for (const core::LawKind kind : core::kLawKinds)
    out += "<th scope=\"col\" class=\"figure\">" + std::string(column_of(kind)) + "</th>";
  return out + "<th scope=\"col\">motion</th><th scope=\"col\">did not apply</th></tr></thead><tbody>" + rows +
         "</tbody></table></section>";
}

}  // namespace broadside::reports
