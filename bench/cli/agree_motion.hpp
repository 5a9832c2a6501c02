// `agree --motion`: continuous collision queries against the exact first touch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/agree/lanes.hpp"
#include "core/result.hpp"

namespace broadside::bench {

struct MotionArguments {
  std::string kind;
  std::uint64_t count = 10000;
  std::uint64_t seed = 1;
  std::string mesh;
  std::vector<std::string> engines;
  std::string folder;
  std::string case_file;  // a saved case of bodies, or a csv file of features
  bool as_json = false;
  AskLimits limits;
};

core::Exit agree_motion(const MotionArguments& arguments);

// "exact-motion: ...": the engines that `agree --motion` can ask, for the help.
std::string motion_engines_text();

}  // namespace broadside::bench
