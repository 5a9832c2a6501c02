// Whether a build is slower or faster than the good one: the gate of 'compare', with both builds in turns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/bisect/quantity.hpp"
#include "bench/bisect/shell_command.hpp"
#include "core/result.hpp"
#include "reports/time_ratio.hpp"

namespace broadside::bench::bisect {

struct TimeSettings {
  double delta = 0.05;           // as 'compare' takes it
  std::uint32_t processes = 15;  // timed processes of each build
  std::uint32_t most = 60;       // of each build, where the first ones do not decide
};

// What is timed: a scene, which both programs run in alternating turns of a millisecond. Without a scene the command of
// the bisection is timed: it leaves cells.json, verdicts.json and samples.json in {out}, and whole processes run one
// after the other in the order ABBA.
struct TimedWork {
  std::string scene;
  std::vector<std::string> engines;
  bool allow_stand_in = false;
  std::uint64_t frames = 0;
  std::string command;
  int lock = -1;  // of the folder's FolderLock
};

// Both builds' rows lie in the folder afterwards, in base/ and head/.
core::Result<std::vector<reports::TimeRatio>> measure_times(const TimedWork& work, const TimeSettings& settings,
                                                            const BuildPlace& good, const BuildPlace& build,
                                                            const std::filesystem::path& folder);

// Reads what measure_times found from the folder that it left.
core::Result<std::vector<reports::TimeRatio>> read_times(const TimeSettings& settings,
                                                         const std::filesystem::path& folder);

// Those that are slower or faster.
std::vector<Difference> time_differences(const std::vector<reports::TimeRatio>& times);

}  // namespace broadside::bench::bisect
