// The settings of one engine in one run: a table of what exists, and the values chosen.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::core {

struct SettingRow {
  std::string_view key;
  std::string_view default_value;
  // The allowed values; empty = a non-negative integer.
  std::vector<std::string_view> allowed;
  std::string_view what;
};

// Every key of the engine's table has a value; keys and values were checked.
class Settings {
 public:
  // Unknown keys and values are errors that name the nearest known one.
  static Result<Settings> parse(std::string_view engine_id, std::span<const SettingRow> table,
                                const std::map<std::string, std::string>& given);

  [[nodiscard]] const std::string& text(std::string_view key) const;
  [[nodiscard]] unsigned long number(std::string_view key) const;
  // "levels=A,variant=sound,...": every key in alphabetical order, for the stamp.
  [[nodiscard]] std::string canonical() const;
  // Only what differs from the defaults, for names that people read: "levels=A"; empty when nothing does.
  [[nodiscard]] std::string short_form() const;

 private:
  struct Value {
    std::string text;
    bool is_default = true;
  };
  std::map<std::string, Value, std::less<>> values_;
};

}  // namespace broadside::core
