#include "reports/terminal_times.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/escape.hpp"
#include "reports/figures.hpp"

namespace broadside::reports {

std::string timing_table(const std::vector<Timing>& timings) {
  if (timings.empty()) return "no times\n";
  std::size_t name_width = 6;
  for (const Timing& t : timings) name_width = std::max(name_width, width(printable(t.stamp.label())));
  std::string text = fmt::format("{:<{}}  {:>10}  {:>12}  {:>25}  {}\n", "engine", name_width, "frames/s",
                                 "median frame", "quartiles", "runs");
  for (const Timing& t : timings) {
    const std::string quartiles = quantity(t.frame.q1, "s") + " to " + quantity(t.frame.q3, "s");
    text += fmt::format("{:<{}}  {:>10}  {:>12}  {:>25}  {}\n", printable(t.stamp.label()), name_width,
                        figure(t.fps.median), quantity(t.frame.median, "s"), quartiles, t.repetitions);
    if (!t.admission.is_admitted)
      text += fmt::format("{:<{}}  does not count: {}\n", "", name_width, printable(t.admission.reason));
  }
  return text;
}

}  // namespace broadside::reports
