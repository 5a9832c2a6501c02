// How far long work is: a line that rewrites itself on a terminal, now and then a plain line otherwise. On stderr.
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

// Is stderr shown to somebody as it is written?
bool is_live();
// Colors: on a terminal that knows them, unless NO_COLOR is set to anything but nothing (no-color.org).
bool has_color();

// On a terminal, the line that stays of an engine that is done: "[2 of 5] bullet-dbvt: recorded, 3000 frames in 4.2 s".
// Elsewhere nothing: the table at the end says it.
void say_done(const core::Cell& cell, std::size_t number, std::size_t of);

}  // namespace broadside::bench
