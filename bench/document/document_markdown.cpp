#include "bench/document/document.hpp"
#include "reports/escape.hpp"

namespace broadside::bench {
namespace {

using reports::markdown;

std::string as_markdown(const Heading& heading) {
  return "## " + markdown(heading.text) + "\n\n";
}

std::string as_markdown(const Paragraph& paragraph) {
  return markdown(paragraph.text) + "\n\n";
}

std::string as_markdown(const Notes& notes) {
  std::string out;
  for (const std::string& item : notes.items) out += "- " + markdown(item) + "\n";
  return out.empty() ? out : out + "\n";
}

std::string as_markdown(const Table& table) {
  std::string out = markdown(table.caption) + "\n\n|";
  for (const std::string& column : table.columns) out += " " + markdown(column) + " |";
  out += "\n|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) out += c == 0 ? "---|" : "---:|";
  out += "\n";
  for (const auto& row : table.rows) {
    out += "|";
    for (const TableCell& cell : row) {
      const std::string text = markdown(cell.text);
      out += " " + (cell.is_struck ? "~~" + text + "~~" : text) + " |";
    }
    out += "\n";
  }
  return out + "\n";
}

std::string as_markdown(const Figure& figure) {
  return "![" + markdown(figure.caption) + "](" + figure.name + ".svg)\n\n";
}

std::string as_markdown(const Mosaic& mosaic) {
  return markdown_of(mosaic);
}

// Markdown text cannot fold, so all blocks are written.
std::string as_markdown(const Fold& fold) {
  std::string out = "### " + markdown(fold.summary) + "\n\n";
  for (const Block& block : fold.blocks) out += std::visit([](const auto& b) { return as_markdown(b); }, block);
  return out;
}

}  // namespace

std::string markdown_text(const Document& document) {
  std::string out = "# " + markdown(document.title) + "\n\n" + markdown(document.lead) + "\n\n";
  for (const Block& block : document.blocks) out += std::visit([](const auto& b) { return as_markdown(b); }, block);
  return out;
}

}  // namespace broadside::bench
