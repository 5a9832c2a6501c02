// An engine's answers about many motions, each asked in a child process.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/agree/lanes.hpp"
#include "bench/agree/motion/motion_test.hpp"

namespace broadside::bench {

struct MotionEngineSpec {
  const core::MotionEngineRow* row = nullptr;
  core::Settings settings;
  std::string label;  // "fcl-motion[solver=naive]"
};

// "fcl-motion[solver=naive,samples=100]". Unknown names are errors that list the known ones.
core::Result<MotionEngineSpec> parse_motion_engine(const std::string& text);

struct MotionAnswer {
  Asked asked = Asked::kNothing;
  bool follows = true;   // false: the engine moves bodies along another path, so it was not asked
  float seconds = 0.0F;  // of this one query, conversions of the adapter included
  core::FirstTouch found;
  std::array<char, 96> thrown{};  // what the library threw, shortened
};

struct MotionAnswers {
  std::vector<MotionAnswer> of_test;
  std::map<std::string, std::uint64_t>
      words;  // how often each last line of a dead process or exception's text occurred
  std::string build;
};

// Must be called before this process has started a thread. Errors: the engine cannot be made, does not answer this
// kind, or refuses the shapes.
core::Result<MotionAnswers> ask_motions(const MotionEngineSpec& engine, MotionKind kind, const Meshes& meshes,
                                        const std::vector<MotionTest>& tests, const AskLimits& limits,
                                        const std::function<void(std::uint64_t)>& progress);

}  // namespace broadside::bench
