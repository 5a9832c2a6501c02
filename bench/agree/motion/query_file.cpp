#include "bench/agree/motion/query_file.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

constexpr int kRows = 8;
constexpr int kColumns = 7;

core::Error fault(const std::filesystem::path& file, std::size_t line, std::string what) {
  return {std::move(what), file.string() + ", line " + std::to_string(line),
          "a row is x, y and z, each as numerator,denominator, and then 0 or 1; a query is eight rows"};
}

std::string_view without_spaces(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool is_integer(std::string_view text) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_above_zero(std::string_view text) {
  return is_integer(text) && text[0] != '-' && text.find_first_of("123456789") != std::string_view::npos;
}

// Splits a line into its cells. Returns what is wrong with the row, or nothing.
std::string split(std::string_view line, std::array<std::string_view, kColumns>& cells) {
  int count = 0;
  for (std::size_t at = 0; at <= line.size(); ++count) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    if (count < kColumns) cells[count] = without_spaces(line.substr(at, end - at));
    at = end + 1;
  }
  if (count != kColumns) return "it has " + std::to_string(count) + " columns, not 7";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!is_integer(cells[2 * axis])) return "'" + std::string(cells[2 * axis]) + "' is no integer";
    if (!is_above_zero(cells[2 * axis + 1]))
      return "the denominator '" + std::string(cells[2 * axis + 1]) + "' is no integer above zero";
  }
  if (cells[6] != "0" && cells[6] != "1") return "the truth is '" + std::string(cells[6]) + "', not 0 or 1";
  return {};
}

}  // namespace

core::Result<std::vector<FileQuery>> read_query_file(const std::filesystem::path& file, continuous::FeatureKind kind) {
  auto text = core::read_whole_file(file);
  if (!text) return text.error();
  std::vector<FileQuery> queries;
  const std::string_view all = text.value();
  std::size_t number = 0;
  int row = 0;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find('\n', at), all.size());
    const std::string_view line = without_spaces(all.substr(at, end - at));
    at = end + 1;
    ++number;
    if (line.empty()) continue;
    std::array<std::string_view, kColumns> cells;
    if (std::string wrong = split(line, cells); !wrong.empty()) return fault(file, number, std::move(wrong));
    if (row == 0) queries.emplace_back();
    FileQuery& query = queries.back();
    query.features.kind = kind;
    const bool touches = cells[6] == "1";
    if (row > 0 && touches != query.touches)
      return fault(file, number, "the eight rows of one query name different truths");
    query.touches = touches;
    for (std::size_t axis = 0; axis < 3; ++axis)
      query.features.points[row][axis] = {std::string(cells[2 * axis]), std::string(cells[2 * axis + 1])};
    row = (row + 1) % kRows;
  }
  if (row != 0) return fault(file, number, "the last query has " + std::to_string(row) + " rows, not 8");
  if (queries.empty()) return fault(file, number, "there is no query");
  return queries;
}

core::Status write_query_file(const std::vector<FileQuery>& queries, const std::filesystem::path& file) {
  std::string text;
  for (const FileQuery& query : queries) {
    for (const auto& point : query.features.points) {
      for (const auto& coordinate : point) text += coordinate.numerator + "," + coordinate.denominator + ",";
      text += query.touches ? "1\n" : "0\n";
    }
  }
  return core::write_whole_file(file, text);
}

}  // namespace broadside::bench
