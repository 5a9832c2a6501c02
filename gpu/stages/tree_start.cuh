// Where a search of two vertex trees by several warps begins: not at the roots, but at the pairs of upper nodes that
// are near each other.
#pragma once

#include "gpu/frame_view.hpp"
#include "gpu/stages/search_stack.cuh"
#include "gpu/stages/team.cuh"
#include "gpu/stages/tree_search.cuh"

namespace broadside::gpu {

// By all warps of a team, whose counts are zero.
//
// Bodies that meet overlap at an edge of theirs: of either tree's upper nodes few are near the other's root. All pairs
// of those are tried, where opening the roots and what is below them would be a wait for memory on each level.
class TreeStart {
 public:
  __device__ TreeStart(const TreePair& trees, const SearchTeam& team) : trees_(trees), team_(team) {}

  // Returns what the stack holds. Where it has no room for so many pairs, the roots are where to begin.
  __device__ TeamCounts begin() const {
    if (trees_.roots().are_leaves()) return begin_at_roots();
    list_near_roots();
    team_.sync();
    // One warp alone can go on from what is put here, as from the roots.
    const std::uint32_t room = team_.nodes().entries - 63 * trees_.top();
    put_near_pairs(room);
    team_.sync();
    const std::uint32_t found = team_.counts[0].nodes;
    return found <= room ? TeamCounts{found, 0} : begin_at_roots();
  }

 private:
  // While there are no pairs of leaves: the numbers of the nodes of A, or of B, that are near the other's root.
  static_assert(kMostUpperNodes <= 64 * 2, "so many words has a team of two");
  __device__ std::uint32_t* near_root(bool of_a) const { return of_a ? team_.leaves().a() : team_.leaves().b(); }

  __device__ TeamCounts begin_at_roots() const {
    const NodePair roots = trees_.roots();
    const TeamCounts left = roots.are_leaves() ? TeamCounts{0, 1} : TeamCounts{1, 0};
    if (team_.member == 0 && lane() == 0) team_.put(left, 0, roots);
    team_.sync();
    return left;
  }

  // Of A they are counted as nodes, of B as leaves.
  __device__ void list_near_roots() const {
    const std::uint32_t warps_of_a = (trees_.upper_count(true) + 31) / 32;
    const std::uint32_t warps = warps_of_a + (trees_.upper_count(false) + 31) / 32;
    for (std::uint32_t w = team_.member; w < warps; w += team_.members) {
      const bool of_a = w < warps_of_a;
      const std::uint32_t k = (of_a ? w : w - warps_of_a) * 32 + lane();
      const bool exists = k < trees_.upper_count(of_a);
      const bool is_near =
          exists && trees_.is_near(squared_gap(trees_.upper(of_a, exists ? k : 0), trees_.root(!of_a)));
      const unsigned found = __ballot_sync(kFullWarp, is_near);
      if (found == 0) continue;
      TeamCounts& count = team_.counts[1];
      const std::uint32_t place = place_in_warp(found, of_a ? &count.nodes : &count.leaves);
      if (is_near) near_root(of_a)[place] = k;
    }
  }

  // All pairs of what is listed, a lane each at a time.
  __device__ void put_near_pairs(std::uint32_t room) const {
    const TeamCounts near = team_.counts[1];
    const std::uint32_t all = near.nodes * near.leaves;
    // Of numbers as small as these the quotient of floats is the integers'.
    static_assert(kMostUpperNodes * kMostUpperNodes < 1U << 16);
    const float share = 1.0F / static_cast<float>(near.leaves);
    for (std::uint32_t first = team_.member * 32; first < all; first += team_.members * 32) {
      const bool exists = first + lane() < all;
      const std::uint32_t n = exists ? first + lane() : first;
      const auto row = static_cast<std::uint32_t>((static_cast<float>(n) + 0.5F) * share);
      const std::uint32_t a = near_root(true)[row];
      const std::uint32_t b = near_root(false)[n - row * near.leaves];
      const float gap2 = squared_gap(trees_.upper(true, a), trees_.upper(false, b));
      const unsigned found = __ballot_sync(kFullWarp, exists && trees_.is_near(gap2));
      if (found == 0) continue;
      const std::uint32_t place = place_in_warp(found, &team_.counts[0].nodes);
      if ((found >> lane() & 1U) != 0 && place < room) team_.nodes().put(place, trees_.upper_pair(a, b, gap2));
    }
  }

  const TreePair& trees_;
  const SearchTeam& team_;
};

}  // namespace broadside::gpu
