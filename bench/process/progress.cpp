#include "bench/process/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/terminal_table.hpp"
#include "reports/wording.hpp"

namespace broadside::bench {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value == nullptr ? "" : value;
}

std::string left_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

bool is_live() {
  return isatty(STDERR_FILENO) != 0 || !variable(kLiveVariable).empty();
}

bool has_color() {
  return isatty(STDERR_FILENO) != 0 && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

void say_done(const core::Cell& cell, std::size_t number, std::size_t of) {
  if (!is_live()) return;
  const bool is_recorded = cell.state == core::CellState::kRecorded;
  std::string word = reports::printable(reports::state_text(cell));
  if (cell.frames > 0)
    word += fmt::format(", {} in {}", reports::counted(cell.frames, "frame"), reports::quantity(cell.wall_s, "s"));
  std::string line = fmt::format("[{} of {}] {}: ", number, of, reports::printable(cell.stamp.label()));
  const std::size_t room = reports::kTerminalColumns - std::min(reports::kTerminalColumns - 10, reports::width(line));
  word = reports::clipped(word, room);
  if (has_color()) word = (is_recorded ? "\033[32m" : "\033[33m") + word + "\033[0m";
  fmt::print(stderr, "\r\033[K{}{}\n", line, word);
}

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)), total_(total), is_terminal_(is_live()), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  if (is_terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::at(std::uint64_t done) {
  const auto now = Clock::now();
  // A terminal is refreshed ten times a second. A log gets a line every quarter of a minute, so short work prints
  // nothing.
  const double wait_s = is_terminal_ ? 0.1 : 15.0;
  if (std::chrono::duration<double>(now - last_).count() < wait_s || done == 0) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = elapsed / static_cast<double>(done) * static_cast<double>(total_ - std::min(done, total_));
  const std::string text =
      fmt::format("{}: {} of {} ({:.0f} %), about {} left", what_, done, total_,
                  100.0 * static_cast<double>(done) / static_cast<double>(total_), left_text(left));
  // The line is cut to the terminal's width, because a wrapped line cannot be rewritten.
  fmt::print(stderr, "{}{}{}", is_terminal_ ? "\r" : "",
             is_terminal_ ? reports::clipped(text, reports::kTerminalColumns - 1) : text,
             is_terminal_ ? "\033[K" : "\n");
  std::fflush(stderr);
}

}  // namespace broadside::bench
