#include <algorithm>

#include "bench/document/document.hpp"
#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/page_assets.hpp"
#include "reports/plots/plot_style.hpp"

namespace broadside::bench {
namespace {

using reports::element;
using reports::html;

// A wide table scrolls sideways. A shadow at an edge shows that there are more columns: the shadow stays at the edge,
// and what covers it scrolls with the table, so the shadow is visible until the last column is.
constexpr std::string_view kBlockStyle = R"(
.wide { overflow-x: auto; margin: .4rem 0 1.2rem; scrollbar-width: thin; scrollbar-color: var(--soft) transparent;
  background: linear-gradient(to right, var(--paper) 60%, transparent) left / 2.5rem 100% no-repeat local,
    linear-gradient(to left, var(--paper) 60%, transparent) right / 2.5rem 100% no-repeat local,
    linear-gradient(to right, var(--soft), transparent) left / .9rem 100% no-repeat scroll,
    linear-gradient(to left, var(--soft), transparent) right / .9rem 100% no-repeat scroll }
.wide table { width: auto; min-width: 60% }
.wide th, .wide td { white-space: nowrap }
.wide td.bad, .wide td.away { white-space: normal; min-width: 10rem }
.wide tbody th { position: sticky; left: 0; background: var(--paper) }
.wide td.good { color: var(--pass) } .wide td.bad { color: var(--fail); font-weight: 600 } .wide td.away { color: var(--soft) }
figure.drawing { margin: 1rem 0; display: inline-block; vertical-align: top; max-width: 100% }
figure.drawing figcaption { font-size: .8rem; color: var(--soft); max-width: 40rem }
.wide.worded tbody th { white-space: normal; overflow-wrap: normal; max-width: 34rem }
.wide td.words { white-space: normal; text-align: left; min-width: 12rem }
.fold { border-bottom: 1px solid var(--line) } .fold > summary { cursor: pointer; padding: .3rem 0; font-size: .875rem }
.fold > summary:hover { color: var(--accent) } .fold .fold { border-bottom: 0 }
.notes li:target { background: var(--open-wash) }
.notes { font-size: .875rem; padding-left: 1.2rem; max-width: 80ch; overflow-wrap: anywhere }
@media screen and (max-width: 60rem) {
  .wide thead { position: static; width: auto; height: auto; clip-path: none }
  .wide table { display: table } .wide thead { display: table-header-group } .wide tbody { display: table-row-group }
  .wide tr { display: table-row } .wide th, .wide td { display: table-cell; padding: .3rem .5rem }
  .wide caption { display: table-caption }
}
@media print {
  .wide { overflow: visible; background: none }
  .wide table { width: 100%; min-width: 0; table-layout: fixed }
  .wide th, .wide td { white-space: normal; overflow-wrap: anywhere; padding: .15rem .2rem; position: static;
    font-size: 6.5pt }
  .wide td.bad, .wide td.away, .wide td.words { min-width: 0 }
  .wide.worded table { table-layout: auto } .wide.worded th, .wide.worded td { overflow-wrap: normal }
  p, .notes { max-width: none } main > .notes { font-size: 7.5pt; margin: .2rem 0 }
  h2 { margin-top: .6rem; break-after: avoid } .wide.mosaic { break-inside: avoid }
  .fold.printed::details-content { content-visibility: visible; display: block; height: auto }
  .wide tr, figure.drawing { break-inside: avoid }
  figure.drawing { width: 48% } figure.drawing svg { width: 100%; height: auto }
}
)";

// Styles that this page needs and the report's own style lacks.
constexpr std::string_view kOwnStyle = R"(
body { padding-top: 1rem } h1 { margin: .6rem 0 .4rem } main > h2:first-child { margin-top: 1rem }
nav ul { list-style: none; padding: 0; display: flex; flex-wrap: wrap; gap: .2rem 1.4rem; font-size: .875rem }
nav a { color: var(--accent) }
)";

constexpr std::string_view kHeadStart = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; )"
                                        R"(form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
)";

std::string as_html(const Heading&) {
  return "";  // the page writes headings, because their level and id depend on it
}

std::string as_html(const Paragraph& paragraph) {
  return element("p", html(paragraph.text)) + "\n";
}

std::string as_html(const Notes& notes) {
  if (notes.items.empty()) return "";
  std::string items;
  for (std::size_t k = 0; k < notes.items.size(); ++k) {
    const std::string item = html(notes.items[k]);
    const bool has_id = k < notes.ids.size() && !notes.ids[k].empty();
    items += (has_id ? element("li", {{"id", notes.ids[k]}}, item) : element("li", item)) + "\n";
  }
  return element("ul.notes", "\n", items) + "\n";
}

std::string as_html(const Table& table) {
  std::vector<reports::Column> columns;
  const auto is_of_words = [&](std::size_t c) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [c](const auto& row) { return c < row.size() && row[c].is_words; });
  };
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    columns.push_back({table.columns[c], c > 0 && !is_of_words(c)});
  std::string rows;
  for (const auto& row : table.rows) {
    std::string cells;
    for (const auto& cell : row) {
      const std::string text = cell.is_struck ? element("s", html(cell.text)) : html(cell.text);
      const std::string kind = cell.is_words ? "td.words" : "td.figure";
      cells += cells.empty() ? reports::row_head(text) : element(kind + std::string(class_of(cell.tone)), text);
    }
    rows += element("tr", cells) + "\n";
  }
  const std::string inside =
      element("caption", html(table.caption)) + reports::table_head(columns) + element("tbody", "\n", rows);
  // Columns of sentences need more room than others, on paper too.
  bool has_words = false;
  for (std::size_t c = 0; c < table.columns.size(); ++c) has_words = has_words || is_of_words(c);
  return element(has_words ? "div.wide.worded" : "div.wide",
                 {{"role", "region"}, {"tabindex", "0"}, {"aria-label", table.caption}}, element("table", inside)) +
         "\n";
}

std::string as_html(const Figure& figure) {
  return element("figure.drawing", figure.inline_svg, element("figcaption", html(figure.caption))) + "\n";
}

std::string as_html(const Mosaic& mosaic) {
  return html_of(mosaic);
}

std::string as_html(const Fold&) {
  return "";  // the page writes folds, because their headings depend on it
}

std::string contents(const Document& document) {
  std::string items;
  for (const Block& block : document.blocks)
    if (const auto* heading = std::get_if<Heading>(&block))
      items += element("li", element("a", {{"href", "#" + heading->id}}, html(heading->text)));
  return element("nav", {{"aria-label", "contents"}}, element("ul", items)) + "\n";
}

std::string html_blocks(const std::vector<Block>& blocks, const std::string& prefix, int heading_level) {
  const std::string level = "h" + std::to_string(heading_level);
  std::string out;
  for (const Block& block : blocks) {
    if (const auto* heading = std::get_if<Heading>(&block))
      out += element(level, {{"id", prefix + heading->id}}, html(heading->text)) + "\n";
    else if (const auto* fold = std::get_if<Fold>(&block))
      out +=
          element(fold->is_printed ? "details.fold.printed" : "details.fold", {{"id", prefix + fold->id}},
                  element("summary", html(fold->summary)), "\n", html_blocks(fold->blocks, prefix, heading_level + 1)) +
          "\n";
    else
      out += std::visit([](const auto& b) { return as_html(b); }, block);
  }
  return out;
}

}  // namespace

std::string_view block_style() {
  return kBlockStyle;
}

std::string html_blocks(const Document& document, const std::string& prefix, int heading_level) {
  return html_blocks(document.blocks, prefix, heading_level);
}

std::string html_text(const Document& document) {
  const std::string style = std::string(reports::kPageStyle) + std::string(kBlockStyle) + std::string(mosaic_style()) +
                            std::string(kOwnStyle) + reports::plots::plot_style();
  return std::string(kHeadStart) + element("title", html(document.title)) + "\n" + element("style", "\n", style) +
         "\n</head>\n<body>\n" +
         element("header", element("p.brand", element("b", "Broadside")), "\n", element("h1", html(document.title)),
                 "\n", element("p", html(document.lead)), "\n", contents(document)) +
         "\n" + element("main", "\n", html_blocks(document, "", 2)) + "\n</body>\n</html>\n";
}

}  // namespace broadside::bench
