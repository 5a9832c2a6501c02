// Measured cells in the form that the tables need: means with their deviations, and which of two is larger.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/document/document.hpp"
#include "bench/paper/paper_row.hpp"

namespace broadside::bench::paper {

// Stands for a missing number.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// A mean over runs. Usable only when it was measured and admitted.
struct Measured {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();  // NaN with fewer than two runs
  bool is_struck = false;    // measured, and not admitted: shown struck out, used nowhere
  std::string absence = {};  // why there is no number; empty when there is one

  [[nodiscard]] bool is_usable() const { return absence.empty() && !is_struck; }
};

// Over these values, one per run. A null row is a cell that was not asked for.
Measured measured(const PaperRow* row, const std::vector<double>& values);
Measured fps_of(const PaperRow* row);

TableCell cell_of(const Measured& value);
TableCell published_cell(double mean, double deviation);
TableCell number_cell(double value, int digits);
// "3.21" = ours over theirs; a dash where either is missing.
TableCell ratio_cell(const Measured& ours, double published);
// Change of `value` against `baseline` in percent, "+8.3 %"; a dash where either is missing.
TableCell change_cell(double value, double baseline);
double change_percent(double value, double baseline);

enum class Order { kHolds, kFails, kOpen, kAbsent };

// Is a larger than b? Undecided when the difference of the means is within the sum of their standard deviations.
Order is_larger(const Measured& a, const Measured& b);
Order both(Order a, Order b);
std::string_view order_word(Order order);

// "A < C < B", ascending, with "~" between two that cannot be told apart. Names are in the given order; absent ones are
// left out.
std::string ascending(std::vector<std::pair<std::string, Measured>> values);

// The rows of one experiment.
class RowTable {
 public:
  RowTable(std::span<const PaperRow> rows, std::string_view experiment);

  // Pairs of model and count, in order of first appearance.
  [[nodiscard]] std::vector<std::pair<std::string, std::uint32_t>> places() const;
  [[nodiscard]] const PaperRow* find(const std::string& model, std::uint32_t count, std::string_view method) const;
  [[nodiscard]] const std::vector<const PaperRow*>& rows() const { return rows_; }
  [[nodiscard]] bool is_empty() const { return rows_.empty(); }

 private:
  std::vector<const PaperRow*> rows_;
};

// Sentences about cells that are absent or struck out: each reason once, with the cells that it applies to.
std::vector<std::string> reasons(const RowTable& table);

}  // namespace broadside::bench::paper
