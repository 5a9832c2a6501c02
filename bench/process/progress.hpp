// Progress of long work on stderr: a line that rewrites itself on a terminal, otherwise a plain line now and then.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/rows.hpp"

namespace broadside::bench {

class Progress {
 public:
  // what: "octree-cpu", "judging octree-cpu". A child process whose parent shows its output live (kLiveVariable) counts
  // as on a terminal.
  Progress(std::string what, std::uint64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void at(std::uint64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::uint64_t total_;
  bool is_terminal_;
  Clock::time_point start_;
  Clock::time_point last_;
};

inline constexpr const char* kLiveVariable = "BROADSIDE_LIVE_PROGRESS";

// Is stderr a terminal, or shown live by the parent?
bool is_live();
// Whether to print in color: on a terminal that has colors, unless NO_COLOR is set to a non-empty value (no-color.org).
bool has_color();

// On a terminal, prints a line for an engine that is done, which stays: "[2 of 5] bullet-dbvt: recorded, 3000 frames in
// 4.2 s". Elsewhere prints nothing, because the table at the end says the same.
void say_done(const core::Cell& cell, std::size_t number, std::size_t of);

}  // namespace broadside::bench
