// Which pairs of bodies have overlapping boxes at the last level of the chosen setting.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/method/levels.hpp"
#include "core/pair.hpp"
#include "reference/octree_cpu/bodies.hpp"
#include "reference/octree_cpu/leaf_boxes.hpp"

namespace broadside::reference {

// From the candidates of a broad phase, which already passed level 0.
class LevelStage {
 public:
  void confirm(const Bodies& bodies, core::Levels levels, std::span<const core::Pair> candidates,
               std::vector<core::Pair>& confirmed);

  // The published start: every pair of bodies, no broad phase before it. Two static bodies are no pair.
  void confirm_all(const Bodies& bodies, core::Levels levels, std::vector<core::Pair>& confirmed);

  // Since reset_counts(). Sums of integers, so no thread order shows in them.
  [[nodiscard]] std::uint64_t pairs_tested() const { return pairs_tested_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t box_tests() const { return box_tests_.load(std::memory_order_relaxed); }
  void reset_counts() { pairs_tested_ = box_tests_ = 0; }

 private:
  LeafBoxes leaf_boxes_;  // of the published start with level A
  std::vector<std::uint8_t> keep_;
  std::vector<std::vector<core::Pair>> rows_;
  std::atomic<std::uint64_t> pairs_tested_{0};
  std::atomic<std::uint64_t> box_tests_{0};
};

}  // namespace broadside::reference
