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
  float seconds = 0.0F;  // of this query with the adapter's conversions; the lesser of elapsed and processor time
  core::Separation separation;
  std::array<char, 96> thrown{};  // what the library threw, shortened
};

struct Answers {
  std::vector<PairAnswer> of_pair;
  // How often each text occurred: the last line that a dying process wrote, or the text of an exception.
  std::map<std::string, std::uint64_t> words;
  std::string build;                         // of the engine
  std::map<std::string, std::string> notes;  // its equivalence card
};

// Each process asks one query at a time. After a crash a new process goes on with the pair after the one that caused
// it. Must be called before this process has started a thread, because the children are forks of it. Errors: the engine
// cannot be made, has no narrow phase, or refuses the shapes. progress is called with the number of pairs done.
core::Result<Answers> ask(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs,
                          const AskLimits& limits, const std::function<void(std::uint64_t)>& progress);

}  // namespace broadside::bench
