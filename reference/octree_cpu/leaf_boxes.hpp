// The level-2 boxes of every body's octree in the world, as columns: level A tests all pairs of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/octree_cpu/bodies.hpp"

namespace broadside::reference {

class LeafBoxes {
 public:
  // Computes the boxes where the bodies are now. Each bound is rounded once, as core::overlaps_at does for each pair
  // anew.
  void place(const Bodies& bodies);

  // The result of core::level2_overlaps for two bodies, with the same count, by several tests an instruction.
  [[nodiscard]] bool overlap(std::uint32_t i, std::uint32_t j, std::uint64_t& tests) const;

  static constexpr std::uint32_t kMost = 64;
  // min x, y, z, max x, y, z of each box. Behind the last box there are some that overlap nothing.
  struct Columns {
    alignas(32) std::array<std::array<float, kMost>, 6> bounds;
    std::uint32_t count = 0;
  };

 private:
  std::vector<Columns> of_body_;
};

}  // namespace broadside::reference
