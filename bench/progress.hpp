// How far long work is: a line that rewrites itself on a terminal, now and then a plain line otherwise. On stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace broadside::bench {

class Progress {
 public:
  // what: "octree-cpu", "judging octree-cpu".
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

}  // namespace broadside::bench
