// The tree's broad phase for boxes that move little from frame to frame: the pairs found are kept for as long as they
// must still contain every overlapping pair.
//
// A search takes boxes that are fattened on each side. Its pairs are candidates for as long as every box lies within
// its fat one: boxes that overlap lie in fat boxes that overlap. A frame in which all boxes do tests the candidates and
// searches nothing; the first box that leaves its fat one causes a new search. So every frame is exact, also when all
// boxes jump. A search whose candidates serve no further frame costs more than a search of boxes that are not fattened.
// So after each such search in a row, twice as many frames as before are searched without fattening, until fattening is
// tried again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "reference/scene_octree/pair_blocks.hpp"
#include "reference/scene_octree/pair_order.hpp"
#include "reference/scene_octree/pass_trees.hpp"

namespace broadside::reference {

// Keeps its memory between calls. Works in the caller's oneTBB arena.
class KeptPairs {
 public:
  // Forgets the candidates found before.
  void start(std::span<const std::uint8_t> is_static);
  // False when a box is not finite or inside out. There must be as many boxes as start() was given.
  [[nodiscard]] bool build(std::span<const core::Box> boxes);
  void find();
  void read_back(std::vector<core::Pair>& out);

  // Since start: frames that were searched, frames that tested candidates alone, and the candidates tested.
  [[nodiscard]] std::uint64_t searched_frames() const { return searched_frames_; }
  [[nodiscard]] std::uint64_t kept_frames() const { return kept_frames_; }
  [[nodiscard]] std::uint64_t candidates_tested() const { return candidates_tested_; }
  [[nodiscard]] const PassTrees& tree() const { return tree_; }

 private:
  [[nodiscard]] bool are_within(std::span<const core::Box> boxes) const;
  void fatten(std::span<const core::Box> boxes);
  void take_candidates();
  void test_candidates();

  std::vector<std::uint8_t> is_static_;
  PassTrees tree_;
  std::vector<core::Box> fat_;
  // The id of each place in the tree's order, in which neighbors in space are neighbors in memory.
  std::vector<std::uint32_t> id_of_place_;
  std::vector<std::uint32_t> place_of_id_;
  std::vector<core::Box> placed_;  // this frame's boxes
  std::vector<std::vector<core::Pair>> candidates_;
  PairBlocks settled_;
  PairOrder order_;
  bool is_fat_ = false;  // the last search was of fat boxes
  bool has_candidates_ = false;
  bool is_kept_ = false;       // this frame needs no search
  std::uint32_t in_vain_ = 0;  // searches in a row whose candidates served no further frame
  std::uint32_t pause_ = 0;    // frames that are still to be searched without fattening
  bool has_served_ = true;
  std::uint64_t searched_frames_ = 0;
  std::uint64_t kept_frames_ = 0;
  std::uint64_t candidates_tested_ = 0;
};

}  // namespace broadside::reference
