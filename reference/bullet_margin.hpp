// The setting by which Bullet's shapes and leaves are fattened.
#pragma once

#include <string_view>

#include "core/engine/length_setting.hpp"

namespace broadside::reference {

// "bullet": what the library ships; otherwise meters.
inline float margin_m_of(const core::Settings& settings, float shipped_m) {
  if (settings.text("margin") == "bullet") return shipped_m;
  return static_cast<float>(core::meters_of(settings, "margin"));
}

}  // namespace broadside::reference
