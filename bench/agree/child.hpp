// The child process that asks an engine about pairs and may crash on one. Its answers lie in shared memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/agree/answers.hpp"
#include "bench/agree/pairs.hpp"
#include "bench/cell/cell_spec.hpp"

namespace broadside::bench {

// What a child reports about its state. Text is written before its size.
struct ChildReport {
  std::uint64_t at = 0;      // the pair that is being asked about, or before which shapes are loaded
  std::uint64_t begun = 0;   // rises with every query and every load
  bool is_querying = false;  // otherwise it makes the engine or loads shapes
  std::uint32_t text_size = 0;
  std::array<char, 1 << 16> text{};

  void say(const std::string& words);
  [[nodiscard]] std::string said() const { return {text.data(), text_size}; }
};

// Exit codes of a child that ended by itself.
inline constexpr int kAllAsked = 0;
inline constexpr int kRefused = 65;  // the engine or its scene: the report's text says why

// Asks about pairs [first, last); an answer has the index of its pair. Returns the exit code.
int ask_pairs(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs, std::size_t first,
              std::size_t last, std::span<Answer> answers, ChildReport& report);

// The engine's own facts, read in a child too: making the engine may start threads, which must not be forked.
struct EngineWords {
  std::string build;
  std::map<std::string, std::string> notes;  // its equivalence card
};
int describe_engine(const CellSpec& cell, const PairSource& source, ChildReport& report);
EngineWords engine_words(const std::string& said);

}  // namespace broadside::bench
