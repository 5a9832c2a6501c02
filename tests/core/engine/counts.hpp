// What an engine counts, by the names of its counters.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "core/engine/counter.hpp"

namespace broadside::tests {

using Counts = std::map<std::string, std::uint64_t, std::less<>>;

template <typename Engine>
Counts counts_of(const Engine& engine) {
  Counts counts;
  for (const core::Counter& counter : engine.counters()) counts[std::string(counter.name)] = counter.count;
  return counts;
}

}  // namespace broadside::tests
