#include "bench/cell/step_selection.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace broadside::bench {
namespace {

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

core::Result<StepSelection> StepSelection::parse(std::uint32_t every, const std::vector<std::string>& windows) {
  StepSelection selection;
  selection.every = every;
  for (const std::string& text : windows) {
    const std::size_t colon = text.find(':');
    const auto first = whole_number(std::string_view(text).substr(0, colon));
    const auto last =
        colon == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(colon + 1));
    if (!first || !last || *first == 0 || *first > *last)
      return core::Error{"'" + text + "' is no window", "--window", "give FIRST:LAST, counted from 1, such as 100:200"};
    selection.windows.push_back({*first, *last});
  }
  return selection;
}

bool StepSelection::has(std::uint64_t step) const {
  if (step % every != 0) return false;
  return windows.empty() || std::any_of(windows.begin(), windows.end(),
                                        [step](const StepWindow& w) { return w.first <= step && step <= w.last; });
}

std::string StepSelection::windows_text() const {
  std::string text;
  for (const StepWindow& w : windows)
    text += (text.empty() ? "" : ",") + std::to_string(w.first) + ":" + std::to_string(w.last);
  return text;
}

}  // namespace broadside::bench
