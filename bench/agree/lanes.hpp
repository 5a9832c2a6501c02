// Processes side by side that ask a library many questions, because the library may crash on any of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace broadside::bench {

enum class Asked : std::uint8_t { kNothing, kAnswered, kThrew, kAborted, kCrashed, kTimedOut };

struct AskLimits {
  double seconds_per_query = 1.0;   // of processor time: others on the machine do not count
  std::uint64_t memory_mib = 4096;  // of address space beyond what this program has
  std::uint32_t processes = 1;      // side by side
};

// What a child reports about its state. Text is written before its size.
struct ChildReport {
  std::uint64_t at = 0;      // the question that is being asked, or before which shapes are loaded
  std::uint64_t begun = 0;   // rises with every query and every load
  bool is_querying = false;  // otherwise it makes the engine or loads shapes
  std::uint32_t text_size = 0;
  std::array<char, 1 << 16> text{};

  // Another process reads it meanwhile.
  void begin(std::size_t place, bool queries);
  void say(const std::string& words);
  [[nodiscard]] std::string said() const { return {text.data(), text_size}; }
};

// Exit codes of a child that ended by itself.
inline constexpr int kAllAsked = 0;
inline constexpr int kRefused = 65;  // the engine or its scene: the report's text says why

// What a child does with questions [next, last); it returns its exit code. Answers go to memory that is shared.
using LiveChild = std::function<int(ChildReport& report, std::size_t next, std::size_t last)>;
// The question at which a child died, how, and its last words.
using OnDeath = std::function<void(std::size_t at, Asked fate, const std::string& words)>;

// What one child said that ended well. Errors: it refused, or died.
core::Result<std::string> said_by_child(std::string_view engine, const AskLimits& limits,
                                        const std::function<int(ChildReport&)>& live);

// One query at a time in each process. After a crash a new process starts behind the question that caused it. Must be
// called before this process has started a thread, because the children are forks of it. progress is called with
// questions done.
core::Status ask_in_children(std::string_view engine, std::size_t questions, const AskLimits& limits,
                             const LiveChild& live, const OnDeath& on_death,
                             const std::function<void(std::uint64_t)>& progress);

}  // namespace broadside::bench
