// The declarations of engines on the page.
#include "reports/declared.hpp"
#include "reports/element.hpp"
#include "reports/escape.hpp"

namespace broadside::reports {
namespace {

std::string labels_of(const DeclaredColumn& column) {
  std::string out;
  for (std::size_t k = 0; k < column.labels.size(); ++k) out += (k == 0 ? "" : ", ") + column.labels[k];
  return out;
}

std::string first_label(const DeclaredColumn& column) {
  return column.labels.front() + (column.labels.size() > 1 ? " and others" : "");
}

std::string row_html(const DeclaredTable& table, std::size_t k) {
  std::string cells;
  for (const DeclaredColumn& column : table.columns) {
    const std::string& value = column.values[k];
    cells += text_cell(first_label(column),
                       value.empty() ? absent_value(html(undeclared_text(table.defaults[k]))) : html(value));
  }
  const std::string meaning = table.meanings[k].empty() ? "" : element("small", html(table.meanings[k]));
  return element("tr", row_head(html(table.keys[k]) + meaning), cells);
}

}  // namespace

std::string declared_html(const SceneView& scene) {
  const DeclaredTable table = declared_table(scene);
  if (table.columns.empty()) return "";
  std::vector<Column> columns{{"declared"}};
  for (const DeclaredColumn& column : table.columns) columns.push_back({labels_of(column)});
  std::string rows;
  for (std::size_t k = 0; k < table.keys.size(); ++k) rows += row_html(table, k);
  return element("h4", "What engines declare about themselves") +
         element("p.hint",
                 "The declaration decides which laws an engine is checked against. Each key that is not declared has "
                 "the value of the simplest correct engine.") +
         element("table.cells.declared", table_head(columns), element("tbody", rows));
}

}  // namespace broadside::reports
