// Which steps of a run are recorded: every k-th of those inside the windows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench {

struct StepWindow {
  std::uint64_t first = 0;
  std::uint64_t last = 0;  // included
};

// The note of a trace's header that holds windows_text().
constexpr const char* kWindowsNote = "windows of steps";

struct StepSelection {
  std::uint32_t every = 1;
  std::vector<StepWindow> windows;  // none = all steps

  // Each text is "A:B". Errors name the text.
  static core::Result<StepSelection> parse(std::uint32_t every, const std::vector<std::string>& windows);

  [[nodiscard]] bool has(std::uint64_t step) const;
  // "100:200,900:1000", for the header's note; empty for all.
  [[nodiscard]] std::string windows_text() const;
};

}  // namespace broadside::bench
