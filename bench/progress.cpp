#include "bench/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace broadside::bench {

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(total),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (is_terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::at(std::uint64_t done) {
  const auto now = Clock::now();
  // A terminal is refreshed ten times a second; a log gets a line a quarter of a minute, so that short work is silent.
  const double wait_s = is_terminal_ ? 0.1 : 15.0;
  if (std::chrono::duration<double>(now - last_).count() < wait_s || done == 0) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = elapsed / static_cast<double>(done) * static_cast<double>(total_ - done);
  const std::string text = fmt::format("{}: {} of {} ({:.0f} %), about {:.0f} s left", what_, done, total_,
                                       100.0 * static_cast<double>(done) / static_cast<double>(total_), left);
  fmt::print(stderr, "{}{}{}", is_terminal_ ? "\r" : "", text, is_terminal_ ? "\033[K" : "\n");
  std::fflush(stderr);
}

}  // namespace broadside::bench
