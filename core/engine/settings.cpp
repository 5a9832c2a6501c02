#include "core/engine/settings.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/nearest_name.hpp"

namespace broadside::core {
namespace {

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.size() <= 9 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
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
    if (row->allowed.empty() ? !is_whole_number(text)
                             : std::find(row->allowed.begin(), row->allowed.end(), text) == row->allowed.end()) {
      return Error{"setting '" + key + "' cannot be '" + text + "'", std::string(engine_id),
                   row->allowed.empty() ? "give a whole number of 0 or more" : advise_name(text, row->allowed)};
    }
    settings.values_[key] = {text, text == row->default_value};
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

}  // namespace broadside::core
