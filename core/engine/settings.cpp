#include "core/engine/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>

#include "core/engine/length_setting.hpp"
#include "core/nearest_name.hpp"

namespace broadside::core {
namespace {

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.size() <= 9 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// The shortest text of the same number, so that "0.020" and "0.02" are one setting with one stamp; nothing when the
// text is not a length.
std::optional<std::string> length_text(const std::string& text) {
  double meters = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), meters);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(meters) || std::signbit(meters))
    return std::nullopt;
  std::array<char, 32> shortest;
  const auto written = std::to_chars(shortest.data(), shortest.data() + shortest.size(), meters);
  return std::string(shortest.data(), written.ptr);
}

// The text under which a setting is stored; nothing when the value is not allowed.
std::optional<std::string> value_of(const SettingRow& row, const std::string& text) {
  if (row.allowed.empty()) return is_whole_number(text) ? std::optional(text) : std::nullopt;
  const auto is_listed = [&](std::string_view word) {
    return std::find(row.allowed.begin(), row.allowed.end(), word) != row.allowed.end();
  };
  if (text != kMeters && is_listed(text)) return text;
  return is_listed(kMeters) ? length_text(text) : std::nullopt;
}

std::string advise_value(const SettingRow& row, const std::string& text) {
  if (row.allowed.empty()) return "give a whole number of 0 or more";
  if (std::find(row.allowed.begin(), row.allowed.end(), kMeters) == row.allowed.end())
    return advise_name(text, row.allowed);
  std::string words;
  for (const std::string_view word : row.allowed)
    if (word != kMeters) words += "'" + std::string(word) + "' or ";
  return "give " + words + "meters, such as 0.02";
}

}  // namespace

Result<Settings> Settings::parse(std::string_view engine_id, std::span<const SettingRow> table,
                                 const std::map<std::string, std::string>& given) {
  Settings settings;
  std::vector<std::string_view> keys;
  for (const SettingRow& row : table) {
    keys.push_back(row.key);
    settings.values_[std::string(row.key)] = {std::string(row.default_value), true};
  }
  for (const auto& [key, text] : given) {
    const auto row =
        std::find_if(table.begin(), table.end(), [&name = key](const SettingRow& r) { return r.key == name; });
    if (row == table.end()) {
      const std::string advice = keys.empty() ? "this engine has no settings" : advise_name(key, keys);
      return Error{"unknown setting '" + key + "'", std::string(engine_id), advice};
    }
    const std::optional<std::string> value = value_of(*row, text);
    if (!value) {
      return Error{"setting '" + key + "' cannot be '" + text + "'", std::string(engine_id), advise_value(*row, text)};
    }
    settings.values_[key] = {*value, *value == row->default_value};
  }
  return settings;
}

const std::string& Settings::text(std::string_view key) const {
  return values_.find(key)->second.text;
}

unsigned long Settings::number(std::string_view key) const {
  return std::strtoul(text(key).c_str(), nullptr, 10);
}

std::string Settings::canonical() const {
  std::string out;
  for (const auto& [key, value] : values_) out += (out.empty() ? "" : ",") + key + "=" + value.text;
  return out;
}

std::string Settings::short_form() const {
  std::string out;
  for (const auto& [key, value] : values_)
    if (!value.is_default) out += (out.empty() ? "" : ",") + key + "=" + value.text;
  return out;
}

double meters_of(const Settings& settings, std::string_view key) {
  return std::strtod(settings.text(key).c_str(), nullptr);
}

}  // namespace broadside::core
