// Builds HTML from elements, so that a part of the page reads as what it shows: element("td.figure", {{"data-name",
// "frames"}}, text). Content is HTML already: text from outside goes through html() (reports/escape.hpp) on its way in.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::reports {

// The value is text and is escaped. An empty one writes the name alone, as "hidden" is written.
struct Attribute {
  std::string_view name;
  std::string value;
};

// `kind` is the tag with its classes, as in a style sheet: "td.figure" is <td class="figure">. HTML elements that have
// no content, such as <meta>, cannot be made with this function.
std::string element_of(std::string_view kind, std::initializer_list<Attribute> attributes, std::string_view content);

template <class... Content>
std::string element(std::string_view kind, std::initializer_list<Attribute> attributes, const Content&... content) {
  std::string inside;
  (inside.append(content), ...);
  return element_of(kind, attributes, inside);
}

template <class... Content>
std::string element(std::string_view kind, const Content&... content) {
  return element(kind, {}, content...);
}

// A column's head; `below` is small print under the name. Both are text.
struct Column {
  std::string name;
  bool is_figure = false;  // figures are set to the right
  std::string below = {};
};
std::string column_head(const Column& column);
std::string table_head(const std::vector<Column>& columns);

// A cell of a table's body. On narrow screens, where the table head is hidden, `name` is shown before the content.
std::string text_cell(std::string_view name, std::string_view content);
std::string figure_cell(std::string_view name, std::string_view content);
// The head of a row.
std::string row_head(std::string_view content);
// What a cell shows where there is no value: "none", "not judged".
std::string absent_value(std::string_view word);
// "<div><dt>name</dt><dd>value</dd></div>", an entry of a list of facts. Both are HTML.
std::string fact_entry(std::string_view name, std::string_view value);

}  // namespace broadside::reports
