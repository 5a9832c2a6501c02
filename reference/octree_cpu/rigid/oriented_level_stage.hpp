// Finds pairs of turned bodies whose body-octree nodes overlap at the last level of the chosen setting: RIGID 8.3.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/method/levels.hpp"
#include "core/pair.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::reference {

class OrientedLevelStage {
 public:
  // candidates: sorted pairs. confirmed: those of them that may come to touch within the step, sorted. Both functions
  // also note in bodies.push how far candidates may push each other in the next step.
  void confirm(core::RigidBodies& bodies, core::Levels levels, std::span<const core::Pair> candidates,
               std::vector<core::Pair>& confirmed);

  // The published start: every pair of bodies, without a broad phase before it. Leaves out two static bodies, and two
  // bodies whose boxes of the whole step do not overlap.
  void confirm_all(core::RigidBodies& bodies, core::Levels levels, std::vector<core::Pair>& confirmed);

  // Counts since reset_counts(). They are sums of integers, so they do not depend on the order of threads.
  [[nodiscard]] std::uint64_t pairs_tested() const { return pairs_tested_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t box_tests() const { return box_tests_.load(std::memory_order_relaxed); }
  void reset_counts() { pairs_tested_ = box_tests_ = 0; }

 private:
  std::vector<std::uint8_t> keep_;
  std::vector<std::vector<core::Pair>> rows_;
  std::atomic<std::uint64_t> pairs_tested_{0};
  std::atomic<std::uint64_t> box_tests_{0};
};

}  // namespace broadside::reference
