// How much work an engine did, in things that can be counted. The counts are the same on every machine, so a changed
// count means a changed program.
#pragma once

#include <cstdint>
#include <string_view>

namespace broadside::core {

// Counted since load. Only quantities that the scene, the settings and the program determine: no times, and no count
// that depends on threads.
struct Counter {
  std::string_view name;  // static storage: "box tests", "nodes visited", "launches", "bytes moved"
  std::uint64_t count = 0;
};

}  // namespace broadside::core
