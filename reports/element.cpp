#include "reports/element.hpp"

#include "reports/escape.hpp"

namespace broadside::reports {

std::string element_of(std::string_view kind, std::initializer_list<Attribute> attributes, std::string_view content) {
  const std::size_t dot = kind.find('.');
  const std::string_view tag = kind.substr(0, dot);
  std::string out = "<" + std::string(tag);
  if (dot != std::string_view::npos) {
    std::string classes(kind.substr(dot + 1));
    for (char& c : classes)
      if (c == '.') c = ' ';
    out += " class=\"" + classes + "\"";
  }
  for (const auto& [name, value] : attributes) {
    out.append(" ").append(name);
    if (!value.empty()) out += "=\"" + html(value) + "\"";
  }
  return out.append(">").append(content).append("</").append(tag).append(">");
}

std::string column_head(const Column& column) {
  return element(column.is_figure ? "th.figure" : "th", {{"scope", "col"}}, html(column.name),
                 column.below.empty() ? "" : element("small", html(column.below)));
}

std::string table_head(const std::vector<Column>& columns) {
  std::string heads;
  for (const Column& column : columns) heads += column_head(column);
  return element("thead", element("tr", heads));
}

std::string text_cell(std::string_view name, std::string_view content) {
  return element("td", {{"data-name", std::string(name)}}, content);
}

std::string figure_cell(std::string_view name, std::string_view content) {
  return element("td.figure", {{"data-name", std::string(name)}}, content);
}

std::string row_head(std::string_view content) {
  return element("th", {{"scope", "row"}}, content);
}

std::string absent_value(std::string_view word) {
  return element("span.void", word);
}

std::string fact_entry(std::string_view name, std::string_view value) {
  return element("div", element("dt", name), element("dd", value));
}

}  // namespace broadside::reports
