// Settings that are lengths: beside their words, their row allows any decimal number of meters.
#pragma once

#include <string_view>

#include "core/engine/settings.hpp"

namespace broadside::core {

// Stands in SettingRow::allowed for a length of 0 or more in meters, as "0.02". The same length always has the same
// text in a stamp: "0.020" is kept as "0.02".
inline constexpr std::string_view kMeters = "METERS";

// The setting in meters. Its value must be a length, not one of its words.
double meters_of(const Settings& settings, std::string_view key);

}  // namespace broadside::core
