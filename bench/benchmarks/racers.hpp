// Which engines take part in the broad-phase suites.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/broad_phase.hpp"

namespace broadside::bench {

struct Racer {
  std::string_view name;
  std::string_view engine;
  std::map<std::string, std::string> settings;
  std::uint32_t most_boxes;  // beyond this a run takes minutes
};

// Every broad phase of the table of engines, and some of their settings.
const std::vector<Racer>& racers();

// Null where the engine cannot run here, with the reason in `why`.
std::unique_ptr<core::BroadPhase> broad_phase_of(const Racer& racer, std::string& why);

}  // namespace broadside::bench
