#include "bench/paper/document.hpp"
#include "reports/escape.hpp"
#include "reports/page_assets.hpp"
#include "reports/plots/plot_style.hpp"

namespace broadside::bench::paper {
namespace {

using reports::html;

// A wide table scrolls sideways. A shadow at an edge says that columns go on there: it stays at the edge, and what
// covers it scrolls with the table, so that it is seen until the last column is.
constexpr std::string_view kBlockStyle =
    ".wide{overflow-x:auto;margin:.4rem 0 1.2rem;scrollbar-width:thin;scrollbar-color:var(--soft) transparent;"
    "background:linear-gradient(to right,var(--paper) 60%,transparent) left/2.5rem 100% no-repeat local,"
    "linear-gradient(to left,var(--paper) 60%,transparent) right/2.5rem 100% no-repeat local,"
    "linear-gradient(to right,var(--soft),transparent) left/.9rem 100% no-repeat scroll,"
    "linear-gradient(to left,var(--soft),transparent) right/.9rem 100% no-repeat scroll}\n"
    ".wide table{width:auto;min-width:60%}\n"
    ".wide th,.wide td{white-space:nowrap}\n"
    "figure.drawing{margin:1rem 0;display:inline-block;vertical-align:top;max-width:100%}\n"
    "figure.drawing figcaption{font-size:.8rem;color:var(--soft);max-width:40rem}\n"
    ".notes{font-size:.875rem;padding-left:1.2rem;max-width:80ch;overflow-wrap:anywhere}\n"
    "@media screen and (max-width:60rem){.wide thead{position:static;width:auto;height:auto;clip-path:none}\n"
    ".wide table{display:table}.wide thead{display:table-header-group}.wide tbody{display:table-row-group}\n"
    ".wide tr{display:table-row}.wide th,.wide td{display:table-cell;padding:.3rem .5rem}\n"
    ".wide caption{display:table-caption}}\n";

// Styles of this page that the report's own style lacks.
constexpr std::string_view kOwnStyle =
    "nav ul{list-style:none;padding:0;display:flex;flex-wrap:wrap;gap:.2rem 1.4rem;font-size:.875rem}\n"
    "nav a{color:var(--accent)}\n";

std::string as_html(const Heading&) {
  return "";  // whose level and id depend on the page
}

std::string as_html(const Paragraph& paragraph) {
  return "<p>" + html(paragraph.text) + "</p>\n";
}

std::string as_html(const Notes& notes) {
  if (notes.items.empty()) return "";
  std::string out = "<ul class=\"notes\">\n";
  for (const std::string& item : notes.items) out += "<li>" + html(item) + "</li>\n";
  return out + "</ul>\n";
}

std::string as_html(const Table& table) {
  std::string out = "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"" + html(table.caption) +
                    "\"><table><caption>" + html(table.caption) + "</caption><thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out +=
        std::string("<th scope=\"col\"") + (c == 0 ? "" : " class=\"figure\"") + ">" + html(table.columns[c]) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string text = row[c].is_struck ? "<s>" + html(row[c].text) + "</s>" : html(row[c].text);
      out += c == 0 ? "<th scope=\"row\">" + text + "</th>" : "<td class=\"figure\">" + text + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string as_html(const Figure& figure) {
  return "<figure class=\"drawing\">" + figure.inline_svg + "<figcaption>" + html(figure.caption) +
         "</figcaption></figure>\n";
}

std::string contents(const Document& document) {
  std::string out = "<nav aria-label=\"contents\"><ul>";
  for (const Block& block : document.blocks)
    if (const auto* heading = std::get_if<Heading>(&block))
      out += "<li><a href=\"#" + html(heading->id) + "\">" + html(heading->text) + "</a></li>";
  return out + "</ul></nav>\n";
}

}  // namespace

std::string_view block_style() {
  return kBlockStyle;
}

std::string html_blocks(const Document& document, const std::string& prefix, int heading_level) {
  const std::string level = std::to_string(heading_level);
  std::string out;
  for (const Block& block : document.blocks) {
    if (const auto* heading = std::get_if<Heading>(&block))
      out += "<h" + level + " id=\"" + html(prefix + heading->id) + "\">" + html(heading->text) + "</h" + level + ">\n";
    else
      out += std::visit([](const auto& b) { return as_html(b); }, block);
  }
  return out;
}

std::string html_text(const Document& document) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      html(document.title) + "</title>\n<style>\n" + std::string(reports::kPageStyle) + std::string(kBlockStyle) +
      std::string(kOwnStyle) + reports::plots::plot_style() +
      "</style>\n</head>\n<body>\n<header><p class=\"brand\"><b>Broadside</b></p>\n<h1>" + html(document.title) +
      "</h1>\n<p>" + html(document.lead) + "</p>\n" + contents(document) + "</header>\n<main>\n";
  return out + html_blocks(document, "", 2) + "</main>\n</body>\n</html>\n";
}

}  // namespace broadside::bench::paper
