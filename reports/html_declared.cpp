// The declarations of engines on the page.
#include "reports/declared.hpp"
#include "reports/escape.hpp"

namespace broadside::reports {
namespace {

std::string head_html(const DeclaredColumn& column) {
  std::string out = "<th scope=\"col\">";
  for (std::size_t k = 0; k < column.labels.size(); ++k) out += (k == 0 ? "" : ", ") + html(column.labels[k]);
  return out + "</th>";
}

std::string first_label(const DeclaredColumn& column) {
  return html(column.labels.front()) + (column.labels.size() > 1 ? " and others" : "");
}

}  // namespace

std::string declared_html(const SceneView& scene) {
  const DeclaredTable table = declared_table(scene);
  if (table.columns.empty()) return "";
  std::string out =
      "<h4>What engines declare of themselves</h4><p class=\"hint\">It decides which laws are held against them; what "
      "is "
      "not declared is taken as a correct engine of the plainest kind would have it.</p><table class=\"cells "
      "declared\"><thead><tr><th scope=\"col\">declared</th>";
  for (const DeclaredColumn& column : table.columns) out += head_html(column);
  out += "</tr></thead><tbody>";
  for (std::size_t k = 0; k < table.keys.size(); ++k) {
    out += "<tr><th scope=\"row\">" + html(table.keys[k]);
    if (!table.meanings[k].empty()) out += "<small>" + html(table.meanings[k]) + "</small>";
    out += "</th>";
    for (const DeclaredColumn& column : table.columns) {
      const std::string& value = column.values[k];
      out += "<td data-name=\"" + first_label(column) + "\">" +
             (value.empty() ? "<span class=\"void\">" + html(undeclared_text(table.defaults[k])) + "</span>"
                            : html(value)) +
             "</td>";
    }
    out += "</tr>";
  }
  return out + "</tbody></table>";
}

}  // namespace broadside::reports
