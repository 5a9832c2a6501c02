// The motion study for people and for programs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/agree/motion/motion_verdicts.hpp"

namespace broadside::bench {

struct MotionStudy {
  std::string label;
  std::string build;
  MotionTable table;
  std::map<std::string, std::uint64_t> words;  // last words of processes, and what was thrown
  std::string absent;                          // why there is nothing; empty when there is
  std::vector<std::string> repeats;            // commands that repeat saved cases
};

// A line for all queries of each engine and one for each family: verdicts, the share missed, how early, how late, how
// fast.
std::string motion_tables(MotionKind kind, const std::vector<MotionStudy>& studies);
std::string motion_json(MotionKind kind, const std::vector<MotionStudy>& studies, std::uint64_t seed);

}  // namespace broadside::bench
