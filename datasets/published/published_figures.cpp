#include "datasets/published/published_figures.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

#include "datasets/published/published_files.hpp"

namespace broadside::datasets {
namespace {

// These files are our own: no field contains a quote or a comma.
std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.emplace_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

PublishedTable parse(std::string_view name, std::string_view csv) {
  PublishedTable table{name, {}, {}};
  while (!csv.empty()) {
    const std::size_t end = std::min(csv.find('\n'), csv.size());
    const std::string_view line = csv.substr(0, end);
    csv.remove_prefix(std::min(csv.size(), end + 1));
    if (line.empty()) continue;
    (table.columns.empty() ? table.columns : table.rows.emplace_back()) = split(line);
  }
  return table;
}

const std::array<PublishedTable, 6>& tables() {
  static const std::array<PublishedTable, 6> kTables{parse("table5", kTable5Csv),   parse("table6", kTable6Csv),
                                                     parse("tableA1", kTableA1Csv), parse("memory", kMemoryCsv),
                                                     parse("figure4", kFigure4Csv), parse("claims", kClaimsCsv)};
  return kTables;
}

}  // namespace

const std::string& PublishedTable::text(std::size_t row, std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) throw std::logic_error("no published column " + std::string(column));
  return rows.at(row).at(static_cast<std::size_t>(found - columns.begin()));
}

double PublishedTable::number(std::size_t row, std::string_view column) const {
  return std::strtod(text(row, column).c_str(), nullptr);
}

std::optional<std::size_t> PublishedTable::find(std::string_view model, std::uint32_t instances) const {
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (text(row, "model") == model && text(row, "instances") == std::to_string(instances)) return row;
  return std::nullopt;
}

const PublishedTable& published_table(std::string_view name) {
  for (const PublishedTable& table : tables())
    if (table.name == name) return table;
  throw std::logic_error("no published table " + std::string(name));
}

}  // namespace broadside::datasets
