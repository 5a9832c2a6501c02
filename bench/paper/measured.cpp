#include "bench/paper/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/figures.hpp"
#include "reports/statistics.hpp"

namespace broadside::bench::paper {
namespace {

constexpr const char* kDash = "\xE2\x80\x93";

}  // namespace

Measured measured(const PaperRow* row, const std::vector<double>& values) {
  Measured m;
  if (row == nullptr) {
    m.absence = "not asked for";
    return m;
  }
  if (!row->absence.empty() || values.empty()) {
    m.absence = row->absence.empty() ? "not measured" : row->absence;
    return m;
  }
  const reports::Summary summary = reports::summarize(values);
  m.mean = summary.mean;
  if (std::isfinite(summary.deviation)) m.deviation = summary.deviation;
  m.is_struck = !row->is_admitted;
  return m;
}

Measured fps_of(const PaperRow* row) {
  return measured(row, row == nullptr ? std::vector<double>{} : row->fps());
}

TableCell cell_of(const Measured& value) {
  if (!value.absence.empty()) return {value.absence == "not asked for" ? value.absence : "absent"};
  TableCell cell{reports::figure(value.mean, 4), value.mean, value.deviation, value.is_struck};
  if (std::isfinite(value.deviation)) cell.text += " \xC2\xB1 " + reports::figure(value.deviation, 2);
  return cell;
}

TableCell published_cell(double mean, double deviation) {
  if (!std::isfinite(mean)) return {kDash};
  TableCell cell{fmt::format("{:g}", mean), mean, deviation};
  if (std::isfinite(deviation)) cell.text += fmt::format(" \xC2\xB1 {:g}", deviation);
  return cell;
}

TableCell number_cell(double value, int digits) {
  if (!std::isfinite(value)) return {kDash};
  return {reports::figure(value, digits), value};
}

TableCell ratio_cell(const Measured& ours, double published) {
  return number_cell(ours.is_usable() ? ours.mean / published : std::nan(""), 3);
}

double change_percent(double value, double baseline) {
  return 100.0 * (value - baseline) / baseline;
}

TableCell change_cell(double value, double baseline) {
  const double change = change_percent(value, baseline);
  if (!std::isfinite(change)) return {kDash};
  return {fmt::format("{:+.1f} %", change), change};
}

Order is_larger(const Measured& a, const Measured& b) {
  if (!a.is_usable() || !b.is_usable()) return Order::kAbsent;
  const double noise =
      (std::isfinite(a.deviation) ? a.deviation : 0.0) + (std::isfinite(b.deviation) ? b.deviation : 0.0);
  if (std::abs(a.mean - b.mean) <= noise) return Order::kOpen;
  return a.mean > b.mean ? Order::kHolds : Order::kFails;
}

Order both(Order a, Order b) {
  for (const Order o : {Order::kAbsent, Order::kFails, Order::kOpen})
    if (a == o || b == o) return o;
  return Order::kHolds;
}

std::string_view order_word(Order order) {
  switch (order) {
    case Order::kHolds:
      return "yes";
    case Order::kFails:
      return "no";
    case Order::kOpen:
      return "not told apart";
    case Order::kAbsent:
      return kDash;
  }
  return kDash;
}

std::string ascending(std::vector<std::pair<std::string, Measured>> values) {
  std::erase_if(values, [](const auto& v) { return !v.second.is_usable(); });
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return a.second.mean < b.second.mean; });
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) text += is_larger(values[k].second, values[k - 1].second) == Order::kHolds ? " < " : " ~ ";
    text += values[k].first;
  }
  return text.empty() ? kDash : text;
}

RowTable::RowTable(std::span<const PaperRow> rows, std::string_view experiment) {
  for (const PaperRow& row : rows)
    if (std::find(row.experiments.begin(), row.experiments.end(), experiment) != row.experiments.end())
      rows_.push_back(&row);
}

std::vector<std::pair<std::string, std::uint32_t>> RowTable::places() const {
  std::vector<std::pair<std::string, std::uint32_t>> places;
  for (const PaperRow* row : rows_) {
    const std::pair<std::string, std::uint32_t> place{row->model, row->count};
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  }
  return places;
}

const PaperRow* RowTable::find(const std::string& model, std::uint32_t count, std::string_view method) const {
  for (const PaperRow* row : rows_)
    if (row->model == model && row->count == count && row->method == method) return row;
  return nullptr;
}

std::vector<std::string> reasons(const RowTable& table) {
  std::map<std::string, std::string> cells_by_reason;
  const auto add = [&](const std::string& reason, const PaperRow& row) {
    std::string& cells = cells_by_reason[reason];
    cells += (cells.empty() ? "" : ", ") + row.model + " " + std::to_string(row.count) + " " + row.method;
  };
  for (const PaperRow* row : table.rows()) {
    if (!row->absence.empty())
      add("Absent, " + row->absence, *row);
    else if (!row->is_admitted)
      add("Struck out, " + row->refusal, *row);
    else if (!row->caveat.empty())
      add("Admitted, with a caveat: " + row->caveat, *row);
    if (row->absence.empty() && row->is_stand_in) add("Stand-in mesh: " + row->mesh, *row);
  }
  std::vector<std::string> sentences;
  sentences.reserve(cells_by_reason.size());
  for (const auto& [reason, cells] : cells_by_reason) sentences.push_back(reason + ": " + cells + ".");
  return sentences;
}

}  // namespace broadside::bench::paper
