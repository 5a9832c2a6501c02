// The motion study as tables for people and as JSON for programs.
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
  std::map<std::string, std::uint64_t> words;  // last lines of processes that died, and texts of exceptions
  std::string absent;                          // why the engine gave no answers; empty when it did
  std::vector<std::string> repeats;            // commands that repeat saved cases
};

// One line of all queries for each engine, and one line for each family: verdicts, the share of touches missed, how
// early and how late the answers are, and how fast.
std::string motion_tables(MotionKind kind, const std::vector<MotionStudy>& studies);
std::string motion_json(MotionKind kind, const std::vector<MotionStudy>& studies, std::uint64_t seed);

}  // namespace broadside::bench
