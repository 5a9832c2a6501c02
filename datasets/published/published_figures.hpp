// The paper's own figures, as printed, to be shown next to ours. Source and columns: README.md in this folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::datasets {

// One of the published tables. The columns are those of the file's first line.
struct PublishedTable {
  std::string_view name;  // "table5"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // one text for each column

  // The text in a column; empty where the row is blank there. The column must exist.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
  [[nodiscard]] double number(std::size_t row, std::string_view column) const;
  // The row of a model and count; nothing when the paper has no such row.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view model, std::uint32_t instances) const;
};

// "table5", "table6", "tableA1", "memory", "figure4", "claims". Any other name ends the program.
const PublishedTable& published_table(std::string_view name);

// Where the published figures were measured.
inline constexpr std::string_view kPublishedMachine =
    "RTX 3090 Ti (24 GB), Core i7-7700K, 32 GB, Windows 10, Unity 2020.3";

}  // namespace broadside::datasets
