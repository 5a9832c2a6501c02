#include "bench/document/document.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/whole_file.hpp"
#include "reports/escape.hpp"

namespace broadside::bench {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_value(const TableCell& cell) {
  if (cell.is_struck) return "struck out";
  return std::isfinite(cell.value) ? fmt::format("{:.8g}", cell.value) : csv_field(cell.text);
}

bool has_deviation(const Table& table, std::size_t column) {
  for (const auto& row : table.rows)
    if (column < row.size() && std::isfinite(row[column].deviation)) return true;
  return false;
}

core::Status write_files(const std::vector<Block>& blocks, const std::filesystem::path& folder) {
  for (const Block& block : blocks) {
    core::Status written = core::Done{};
    if (const auto* table = std::get_if<Table>(&block))
      written = core::write_whole_file(folder / (table->name + ".csv"), csv_text(*table));
    if (const auto* figure = std::get_if<Figure>(&block))
      written = core::write_whole_file(folder / (figure->name + ".svg"), figure->file_svg);
    if (const auto* fold = std::get_if<Fold>(&block)) written = write_files(fold->blocks, folder);
    if (!written) return written;
  }
  return core::Done{};
}

}  // namespace

std::string csv_text(const Table& table) {
  std::string out;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    out += (c == 0 ? "" : ",") + csv_field(table.columns[c]);
    if (has_deviation(table, c)) out += "," + csv_field(table.columns[c] + "_std");
  }
  out += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      out += (c == 0 ? "" : ",") + csv_value(row[c]);
      if (!has_deviation(table, c)) continue;
      out += ",";
      if (std::isfinite(row[c].deviation) && !row[c].is_struck) out += fmt::format("{:.4g}", row[c].deviation);
    }
    out += "\n";
  }
  return out;
}

core::Status write_document(const Document& document, const std::filesystem::path& folder, const std::string& name) {
  if (core::Status s = write_files(document.blocks, folder); !s) return s;
  if (core::Status s = core::write_whole_file(folder / (name + ".md"), markdown_text(document)); !s) return s;
  return core::write_whole_file(folder / (name + ".html"), html_text(document));
}

}  // namespace broadside::bench
