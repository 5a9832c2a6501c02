// Two runs side by side as plain text; declared in comparison.hpp.
#include <algorithm>
#include <nlohmann/json.hpp>

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
    case Speed::kSame:
      return "same";
    case Speed::kInconclusive:
      return "INCONCLUSIVE";
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
  const auto unsure = static_cast<std::uint64_t>(std::count_if(
      c.times.begin(), c.times.end(), [](const TimeRatio& t) { return t.speed == Speed::kInconclusive; }));
  const auto more_work = static_cast<std::uint64_t>(std::count_if(
      c.changes.begin(), c.changes.end(), [](const Change& x) { return x.kind == ChangeKind::kMoreWork; }));
  const auto worse = count(core::Exit::kFailed) - more_work;
  std::string text;
  const auto add = [&](std::uint64_t n, const std::string& what) {
    if (n > 0) text += (text.empty() ? "" : ", ") + what;
  };
  add(worse, counted(worse, "verdict") + " worse");
  add(count(core::Exit::kMissing), counted(count(core::Exit::kMissing), "result") + " missing or no longer conclusive");
  add(slower, counted(slower, "time") + " slower");
  add(more_work, counted(more_work, "counter") + " up");
  add(unsure, counted(unsure, "time") + " inconclusive");
  if (text.empty()) text = "Nothing got worse";
  text += "; " + counted(c.same_verdicts, "verdict") + " unchanged";
  if (c.same_counters > 0) text += ", " + counted(c.same_counters, "counter") + " equal";
  if (c.still_failing > 0)
    text += ", of which " + counted(c.still_failing) + " failed before and still " +
            (c.still_failing == 1 ? "fails" : "fail");
  return text + ".";
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string text = sentence(comparison) + "\n";
  for (const std::string& remark : comparison.remarks) text += "NOTE    " + printable(remark) + "\n";
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
              "], " + counted(time.base_processes) + " and " + counted(time.head_processes) + " processes" +
              (time.is_paired ? " in turns" : "") + ", delta " + percent(comparison.delta);
      if (!time.reason.empty()) text += ": " + printable(time.reason);
    }
    text += "\n";
  }
  return text;
}

std::string comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json changes = nlohmann::ordered_json::array();
  for (const Change& c : comparison.changes)
    changes.push_back({{"scene", c.scene},
                       {"label", c.label},
                       {"subject", c.subject},
                       {"was", c.was},
                       {"is", c.is},
                       {"exit", static_cast<int>(c.exit)}});
  nlohmann::ordered_json times = nlohmann::ordered_json::array();
  for (const TimeRatio& t : comparison.times) {
    nlohmann::ordered_json one{
        {"scene", t.scene}, {"label", t.label}, {"speed", speed_word(t.speed)}, {"reason", t.reason}};
    if (t.speed != Speed::kNotComparable) {
      one["ratio"] = t.ratio;
      one["low"] = t.low;
      one["high"] = t.high;
      one["base_processes"] = t.base_processes;
      one["head_processes"] = t.head_processes;
      one["paired"] = t.is_paired;
    }
    times.push_back(std::move(one));
  }
  const nlohmann::ordered_json document{{"format", "broadside-comparison"},
                                        {"version", 1},
                                        {"exit", static_cast<int>(comparison.exit())},
                                        {"sentence", sentence(comparison)},
                                        {"delta", comparison.delta},
                                        {"looks", comparison.looks},
                                        {"remarks", comparison.remarks},
                                        {"same_verdicts", comparison.same_verdicts},
                                        {"same_counters", comparison.same_counters},
                                        {"changes", std::move(changes)},
                                        {"times", std::move(times)}};
  return document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace broadside::reports
