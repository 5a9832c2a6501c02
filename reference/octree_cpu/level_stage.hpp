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

// Starts from the candidates of a broad phase, which already passed level 0.
class LevelStage {
 public:
  void confirm(const Bodies& bodies, core::Levels levels, std::span<const core::Pair> candidates,
               std::vector<core::Pair>& confirmed);

  // The published start: tests every pair of bodies, with no broad phase before it. Two static bodies make no pair.
  void confirm_all(const Bodies& bodies, core::Levels levels, std::vector<core::Pair>& confirmed);

  // Counts since reset_counts(). They are sums of integers, so they do not depend on the order of threads.
  [[nodiscard]] std::uint64_t pairs_tested() const { return pairs_tested_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t box_tests() const { return box_tests_.load(std::memory_order_relaxed); }
  void reset_counts() { pairs_tested_ = box_tests_ = 0; }

 private:
  LeafBoxes leaf_boxes_;  // for the published start with level A
  std::vector<std::uint8_t> keep_;
  std::vector<std::vector<core::Pair>> rows_;
  std::atomic<std::uint64_t> pairs_tested_{0};
  std::atomic<std::uint64_t> box_tests_{0};
};

}  // namespace broadside::reference
