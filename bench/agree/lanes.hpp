// Processes side by side that ask a library many questions. They are processes because the library may crash.
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
  double seconds_per_query = 1.0;   // of processor time, which other programs on the machine do not increase
  std::uint64_t memory_mib = 4096;  // of address space beyond what this program has
  std::uint32_t processes = 1;      // side by side
};

// What a child reports about its state. Text is written before its size.
struct ChildReport {
  std::uint64_t at = 0;      // the question that is being asked, or the next one while shapes are loaded
  std::uint64_t begun = 0;   // counts the queries and loads that have begun
  bool is_querying = false;  // otherwise it makes the engine or loads shapes
  std::uint32_t text_size = 0;
  std::array<char, 1 << 16> text{};

  // The parent reads the report while the child changes it.
  void begin(std::size_t place, bool queries);
  void say(const std::string& words);
  [[nodiscard]] std::string said() const { return {text.data(), text_size}; }
};

// Exit codes of a child that ended by itself.
inline constexpr int kAllAsked = 0;
inline constexpr int kRefused = 65;  // the engine or its scene was refused: the report's text says why

// What a child does with questions [next, last); it returns its exit code. Answers go to memory that the parent shares.
using LiveChild = std::function<int(ChildReport& report, std::size_t next, std::size_t last)>;
// Called with the question at which a child died, how it died, and the last line that it wrote.
using OnDeath = std::function<void(std::size_t at, Asked fate, const std::string& words)>;

// What a child wrote to its report when it ended well. Errors: it refused, or died.
core::Result<std::string> said_by_child(std::string_view engine, const AskLimits& limits,
                                        const std::function<int(ChildReport&)>& live);

// Each process asks one query at a time. After a crash a new process goes on with the question after the one that
// caused it. Must be called before this process has started a thread, because the children are forks of it. progress is
// called with the number of questions done.
core::Status ask_in_children(std::string_view engine, std::size_t questions, const AskLimits& limits,
                             const LiveChild& live, const OnDeath& on_death,
                             const std::function<void(std::uint64_t)>& progress);

}  // namespace broadside::bench
