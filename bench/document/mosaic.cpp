#include "bench/document/mosaic.hpp"

#include <algorithm>

#include "reports/element.hpp"
#include "reports/escape.hpp"

namespace broadside::bench {
namespace {

using reports::element;
using reports::html;

// Squares keep their size on every screen and on paper; where a screen is too narrow, the table scrolls sideways.
constexpr std::string_view kStyle = R"(
.wide.mosaic table { width: auto; min-width: 0; table-layout: auto; font-size: .75rem; border-collapse: separate;
  border-spacing: 1px }
.wide.mosaic caption { padding: 0 }
.wide.mosaic th, .wide.mosaic td { padding: 0; border: 0; white-space: nowrap; overflow-wrap: normal; line-height: 1 }
.wide.mosaic thead th { vertical-align: bottom; height: 7.8rem; font-size: .7rem; font-weight: 400 }
.wide.mosaic thead th span { writing-mode: vertical-rl; rotate: 180deg; display: inline-block; width: 15px;
  line-height: 15px; text-align: left }
.wide.mosaic tbody th { padding-right: .5rem; font-size: .75rem }
.wide.mosaic .apart { padding-left: 4px }
.wide.mosaic tbody tr:hover th { color: var(--accent) }
.wide.mosaic thead a { color: inherit; text-decoration: none } .wide.mosaic thead a:hover { text-decoration: underline }
.square { display: inline-block; vertical-align: top; width: 15px; height: 15px; line-height: 15px; font-size: 10px;
  text-align: center; border-radius: 2px; color: var(--soft); text-decoration: none; print-color-adjust: exact;
  -webkit-print-color-adjust: exact }
.square.good { background: color-mix(in srgb, var(--pass) 30%, var(--paper)); color: var(--pass) }
.square.bad { background: var(--fail); color: var(--on-fail) }
.square.open { background: var(--open-wash); color: var(--open); font-weight: 700; box-shadow: inset 0 0 0 2px var(--open) }
.square.away { box-shadow: inset 0 0 0 1px var(--line) }
a.square:hover, a.square:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px }
.legend-of-squares { display: flex; flex-wrap: wrap; gap: .2rem 1.4rem; list-style: none; padding: 0; margin: .2rem 0;
  font-size: .8rem; color: var(--soft) }
@media print {
  .wide.mosaic th, .wide.mosaic thead th, .wide.mosaic tbody th { font-size: 6.5pt }
  .wide.mosaic thead th span { width: 11px; line-height: 11px }
  .square { width: 11px; height: 10px; line-height: 10px; font-size: 7.5px }
  .wide.mosaic { margin-top: 0 }
}
)";

std::string square_html(const Square& square) {
  const std::string kind = ".square" + std::string(square.is_open ? ".open" : class_of(square.tone));
  if (square.target.empty()) return element("span" + kind, {{"title", square.words}}, html(square.mark));
  return element("a" + kind, {{"href", "#" + square.target}, {"title", square.words}}, html(square.mark));
}

std::string group_class(const MosaicColumn& column) {
  return column.starts_group ? ".apart" : "";
}

std::string head_html(const Mosaic& mosaic) {
  std::string heads = element("td");
  for (const MosaicColumn& column : mosaic.columns) {
    const std::string name =
        column.target.empty() ? html(column.name) : element("a", {{"href", "#" + column.target}}, html(column.name));
    heads += element("th" + group_class(column), {{"scope", "col"}}, element("span", name));
  }
  return element("thead", element("tr", heads));
}

}  // namespace

std::string html_of(const Mosaic& mosaic) {
  std::string rows;
  for (const MosaicRow& row : mosaic.rows) {
    std::string cells = reports::row_head(html(row.name));
    for (std::size_t c = 0; c < row.squares.size() && c < mosaic.columns.size(); ++c)
      cells += element("td" + group_class(mosaic.columns[c]), square_html(row.squares[c]));
    rows += element("tr", cells) + "\n";
  }
  std::string legend;
  for (const Square& square : mosaic.legend)
    legend += element("li", square_html({square.tone, square.is_open, square.mark, "", ""}), " ", html(square.words));
  const std::string table = element("table", element("caption", element("span.unseen", html(mosaic.caption))),
                                    head_html(mosaic), element("tbody", "\n", rows));
  return element("ul.legend-of-squares", legend) + "\n" +
         element("div.wide.mosaic", {{"role", "region"}, {"tabindex", "0"}, {"aria-label", mosaic.caption}}, table) +
         "\n";
}

std::string_view mosaic_style() {
  return kStyle;
}

std::string markdown_of(const Mosaic& mosaic) {
  std::size_t longest = 0;
  for (const MosaicRow& row : mosaic.rows) longest = std::max(longest, reports::width(row.name));
  std::string out = reports::markdown(mosaic.caption) + "\n\n";
  for (const Square& square : mosaic.legend)
    out += "- " + reports::markdown((square.mark.empty() ? "." : square.mark) + ": " + square.words) + "\n";
  out += "\n```text\n";
  for (const MosaicRow& row : mosaic.rows) {
    out += reports::printable(row.name) + std::string(longest - reports::width(row.name) + 1, ' ');
    for (std::size_t c = 0; c < row.squares.size() && c < mosaic.columns.size(); ++c) {
      if (mosaic.columns[c].starts_group) out += ' ';
      out += row.squares[c].mark.empty() ? "." : row.squares[c].mark;
    }
    out += '\n';
  }
  return out + "```\n\n";
}

}  // namespace broadside::bench
