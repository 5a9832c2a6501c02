// Two runs side by side as plain text; declared in comparison.hpp.
#include <algorithm>

#include "reports/comparison.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"

namespace broadside::reports {
namespace {

std::string_view mark(const Change& change) {
  switch (change.exit) {
    case core::Exit::kFailed:
      return "WORSE   ";
    case core::Exit::kMissing:
      return "MISSING ";
    default:
      return "better  ";
  }
}

std::string_view speed_word(Speed speed) {
  switch (speed) {
    case Speed::kSlower:
      return "SLOWER";
    case Speed::kFaster:
      return "faster";
    case Speed::kNoDifferenceShown:
      return "no difference shown";
    case Speed::kNotComparable:
      return "not comparable";
  }
  return "";
}

std::string sentence(const Comparison& c) {
  const auto count = [&](core::Exit exit) {
    return static_cast<std::uint64_t>(
        std::count_if(c.changes.begin(), c.changes.end(), [&](const Change& change) { return change.exit == exit; }));
  };
  const auto slower = static_cast<std::uint64_t>(
      std::count_if(c.times.begin(), c.times.end(), [](const TimeRatio& t) { return t.speed == Speed::kSlower; }));
  std::string text;
  const auto add = [&](std::uint64_t n, const std::string& what) {
    if (n > 0) text += (text.empty() ? "" : ", ") + what;
  };
  add(count(core::Exit::kFailed), counted(count(core::Exit::kFailed), "verdict") + " worse");
  add(count(core::Exit::kMissing), counted(count(core::Exit::kMissing), "result") + " missing or no longer conclusive");
  add(slower, counted(slower, "time") + " slower");
  if (text.empty()) text = "Nothing got worse";
  text += "; " + counted(c.same_verdicts, "verdict") + " unchanged";
  if (c.still_failing > 0)
    text += ", of which " + counted(c.still_failing) + " failed before and still " +
            (c.still_failing == 1 ? "fails" : "fail");
  return text + ".";
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string text = sentence(comparison) + "\n";
  for (const Change& change : comparison.changes)
    text += std::string(mark(change)) + printable(change.scene) + " " + printable(change.label) + ": " +
            printable(change.subject) + " was " + printable(change.was) + ", is " + printable(change.is) + "\n";
  for (const TimeRatio& time : comparison.times) {
    text +=
        "time    " + printable(time.scene) + " " + printable(time.label) + ": " + std::string(speed_word(time.speed));
    if (time.speed == Speed::kNotComparable) {
      text += ": " + printable(time.reason);
    } else {
      text += ", head / base " + figure(time.ratio, 4) + " [" + figure(time.low, 4) + ", " + figure(time.high, 4) +
              "], " + counted(time.base_runs) + " and " + counted(time.head_runs) + " runs";
    }
    text += "\n";
  }
  return text;
}

}  // namespace broadside::reports
