// The life of a process that asks an engine about pairs and may die of it. What it leaves lies in shared memory.
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

// What a child says of where it is. Text is written before its size.
struct ChildReport {
  std::uint64_t at = 0;      // the pair that is being asked about, or before which shapes are loaded
  std::uint64_t begun = 0;   // rises with every query and every load
  bool is_querying = false;  // otherwise it makes the engine or loads shapes
  std::uint32_t text_size = 0;
  std::array<char, 1 << 16> text{};

  void say(const std::string& words);
  [[nodiscard]] std::string said() const { return {text.data(), text_size}; }
};

// Exit codes of a child that nobody killed.
inline constexpr int kAllAsked = 0;
inline constexpr int kRefused = 65;  // the engine or its scene: the report's text says why

// Asks about pairs [first, last); the answers' index is that of the pair. Returns the exit code.
int ask_pairs(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs, std::size_t first,
              std::size_t last, std::span<Answer> answers, ChildReport& report);

// What an engine says of itself, asked in a child too: making it may start what must not be forked.
struct EngineWords {
  std::string build;
  std::map<std::string, std::string> notes;  // its equivalence card
};
int describe_engine(const CellSpec& cell, const PairSource& source, ChildReport& report);
EngineWords engine_words(const std::string& said);

}  // namespace broadside::bench
