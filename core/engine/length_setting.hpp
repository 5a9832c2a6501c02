// Settings that are lengths: their row allows any decimal number of meters, in addition to its words.
#pragma once

#include <string_view>

#include "core/engine/settings.hpp"

namespace broadside::core {

// An entry of SettingRow::allowed that stands for a length of 0 or more in meters, as "0.02". The same length always
// has the same text in a stamp: "0.020" is kept as "0.02".
inline constexpr std::string_view kMeters = "METERS";

// The setting in meters. Its value must be a length, not one of its words.
double meters_of(const Settings& settings, std::string_view key);

}  // namespace broadside::core
