// An engine's answers about many pairs, each asked in a child process, because the library may crash.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/agree/lanes.hpp"
#include "bench/agree/pairs.hpp"
#include "bench/cell/cell_spec.hpp"
#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

struct PairAnswer {
  Asked asked = Asked::kNothing;
  float seconds = 0.0F;  // of this one query, the adapter's conversions included; elapsed or processor time, the lesser
  core::Separation separation;
  std::array<char, 96> thrown{};  // what the library threw, shortened
};

struct Answers {
  std::vector<PairAnswer> of_pair;
  // Last words of processes that died, or the text of exceptions -> how often.
  std::map<std::string, std::uint64_t> words;
  std::string build;                         // of the engine
  std::map<std::string, std::string> notes;  // its equivalence card
};

// One query at a time in each process. After a crash a new process starts behind the pair that caused it. Must be
// called before this process has started a thread, because the children are forks of it. Errors: the engine cannot be
// made, has no narrow phase, or refuses the shapes. progress is called with pairs done.
core::Result<Answers> ask(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs,
                          const AskLimits& limits, const std::function<void(std::uint64_t)>& progress);

}  // namespace broadside::bench
