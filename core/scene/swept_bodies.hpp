// Which bodies an engine sweeps along their paths, so that they pass through nothing within a step
// (core/method/rigid/sweep.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace broadside::core {

enum class Swept : std::uint8_t { kNobody, kFlagged, kAll };

// The value of the setting "sweep".
inline Swept swept_named(std::string_view word) {
  if (word == "fast") return Swept::kAll;
  return word == "off" ? Swept::kNobody : Swept::kFlagged;
}

// One entry per body, 1 = it is swept, against every body that it may meet; empty where no body is.
inline std::vector<std::uint8_t> swept_bodies(const Scene& scene, Swept swept) {
  if (swept == Swept::kAll) return std::vector<std::uint8_t>(scene.bodies.size(), 1);
  if (swept == Swept::kNobody) return {};
  const bool has_fast = std::find(scene.is_fast.begin(), scene.is_fast.end(), 1) != scene.is_fast.end();
  return has_fast ? scene.is_fast : std::vector<std::uint8_t>{};
}

}  // namespace broadside::core
