#include "core/energy_series.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/whole_file.hpp"

namespace broadside::core {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Reads the column into `out`. Returns what is wrong with it; empty when nothing is.
std::string read_numbers(const OrderedJson& row, std::string_view key, std::size_t count, std::vector<double>& out) {
  const auto at = row.find(std::string(key));
  if (at == row.end() || !at->is_array() || at->size() != count)
    return std::string(key) + " does not have one number per step";
  for (const OrderedJson& number : *at) {
    if (!number.is_number()) return std::string(key) + " has an entry that is not a number";
    out.push_back(number.get<double>());
  }
  return "";
}

std::string read_series(const OrderedJson& row, EnergySeries& series) {
  if (!row.is_object()) return "a row is not an object";
  for (const auto& [key, text] :
       {std::pair{"trace_file", &series.trace_file}, {"scene_name", &series.scene_name}, {"label", &series.label}}) {
    const auto at = row.find(key);
    if (at == row.end() || !at->is_string()) return std::string(key) + " is not text";
    *text = at->get<std::string>();
  }
  const auto steps = row.find("step");
  if (steps == row.end() || !steps->is_array()) return "step is not a list";
  for (const OrderedJson& step : *steps) {
    if (!step.is_number_unsigned()) return "step has an entry that is not a whole number";
    series.step.push_back(step.get<std::uint64_t>());
  }
  for (std::size_t k = 0; k < kEnergyColumnCount; ++k)
    if (std::string wrong = read_numbers(row, kEnergyColumns[k], series.step.size(), series.joule[k]); !wrong.empty())
      return wrong;
  return "";
}

}  // namespace

Status write_energy(const std::filesystem::path& file, const std::vector<EnergySeries>& series) {
  OrderedJson rows = OrderedJson::array();
  for (const EnergySeries& s : series) {
    OrderedJson row{{"trace_file", s.trace_file}, {"scene_name", s.scene_name}, {"label", s.label}, {"unit", "J"}};
    row["step"] = s.step;
    for (std::size_t k = 0; k < kEnergyColumnCount; ++k) row[std::string(kEnergyColumns[k])] = s.joule[k];
    rows.push_back(std::move(row));
  }
  const OrderedJson all{{"format", "broadside-energy"}, {"version", 1}, {"rows", std::move(rows)}};
  // Bytes that are not UTF-8 are replaced, as in the other rows.
  return write_whole_file(file, all.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "\n");
}

Result<std::vector<EnergySeries>> read_energy(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "energy.json";
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return std::vector<EnergySeries>{};
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  const auto malformed = [&file](const std::string& what) {
    return Error{what, file.string(), "write it again: broadside check TRACE --energy " + file.string()};
  };
  const OrderedJson all = OrderedJson::parse(text.value(), nullptr, false);
  if (all.is_discarded() || !all.is_object()) return malformed("it is not JSON");
  if (all.value("format", OrderedJson()) != "broadside-energy" || all.value("version", OrderedJson()) != 1)
    return malformed("it is not of format broadside-energy, version 1");
  const auto rows = all.find("rows");
  if (rows == all.end() || !rows->is_array()) return malformed("it has no list of rows");
  std::vector<EnergySeries> series;
  for (const OrderedJson& row : *rows)
    if (std::string wrong = read_series(row, series.emplace_back()); !wrong.empty())
      return malformed("row " + std::to_string(series.size() - 1) + ": " + wrong);
  return series;
}

}  // namespace broadside::core
