// The child process that asks an engine about pairs and may crash on one. It writes its answers to shared memory.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/agree/answers.hpp"
#include "bench/agree/pairs.hpp"
#include "bench/cell/cell_spec.hpp"

namespace broadside::bench {

// Asks about pairs [first, last); the answer to pair k is answers[k]. Returns the exit code.
int ask_pairs(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs, std::size_t first,
              std::size_t last, std::span<PairAnswer> answers, ChildReport& report);

// The engine's own facts, read in a child too: making the engine may start threads, which must not be forked.
struct EngineWords {
  std::string build;
  std::map<std::string, std::string> notes;  // its equivalence card
};
int describe_engine(const CellSpec& cell, const PairSource& source, ChildReport& report);
EngineWords engine_words(const std::string& said);

}  // namespace broadside::bench
