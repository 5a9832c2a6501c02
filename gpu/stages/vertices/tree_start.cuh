// Begins a search of two vertex trees by several warps: not at the roots, but at the pairs of upper nodes that are near
// each other.
#pragma once

#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/vertices/search_stack.cuh"
#include "gpu/stages/vertices/tree_search.cuh"

namespace broadside::gpu {

// Called by all warps of a team, whose counts must be zero.
//
// Bodies that touch overlap only near their surfaces, so few upper nodes of either tree are near the other's root. All
// pairs of these are tried. Opening the roots and the nodes below them would instead wait for memory on each level.
class TreeStart {
 public:
  __device__ TreeStart(const TreePair& trees, const SearchTeam& team) : trees_(trees), team_(team) {}

  // Returns what the stack holds: pairs of upper nodes or, if there is no room for these, the roots.
  __device__ TeamCounts begin() const {
    if (trees_.roots().are_leaves()) return begin_at_roots();
    list_near_roots();
    team_.sync();
    // Leaves enough of the stack free for one warp alone to go on from these pairs, as it could from the roots.
    const std::uint32_t room = team_.nodes().entries - 63 * trees_.top();
    put_near_pairs(room);
    team_.sync();
    const std::uint32_t found = pairs().nodes;
    return found <= room ? TeamCounts{found, 0} : begin_at_roots();
  }

 private:
  // The numbers of the nodes of A, or of B, that are near the other's root. They use the stack of leaves, which is
  // still empty.
  static_assert(kMostUpperNodes <= 64 * 2, "so many words has a team of two");
  __device__ std::uint32_t* near_root(bool of_a) const { return of_a ? team_.leaves().a() : team_.leaves().b(); }

  // The number of pairs, and the numbers of listed nodes: of A in `nodes`, of B in `leaves`. Later rounds clear both
  // before they add to them. The second of the team's counts, to which the first round adds, stays zero.
  __device__ TeamCounts& pairs() const { return team_.counts[0]; }
  __device__ TeamCounts& listed() const { return team_.counts[kTeamTurns - 1]; }

  __device__ TeamCounts begin_at_roots() const {
    const NodePair roots = trees_.roots();
    const TeamCounts left = roots.are_leaves() ? TeamCounts{0, 1} : TeamCounts{1, 0};
    if (team_.member == 0 && lane() == 0) team_.put(left, 0, roots);
    team_.sync();
    return left;
  }

  __device__ void list_near_roots() const {
    const std::uint32_t warps_of_a = (trees_.upper_count(true) + 31) / 32;
    const std::uint32_t warps = warps_of_a + (trees_.upper_count(false) + 31) / 32;
    for (std::uint32_t w = team_.member; w < warps; w += team_.members) {
      const bool of_a = w < warps_of_a;
      const std::uint32_t k = (of_a ? w : w - warps_of_a) * 32 + lane();
      const std::uint32_t count = trees_.upper_count(of_a);
      const core::Box box = trees_.upper(of_a, min(k, count)).box;
      const core::Box root = trees_.upper(!of_a, trees_.upper_count(!of_a)).box;
      const unsigned found = __ballot_sync(kFullWarp, k < count && trees_.is_near(squared_gap(box, root)));
      if (found == 0) continue;
      const bool is_near = (found >> lane() & 1U) != 0;
      const std::uint32_t place = place_in_warp(found, of_a ? &listed().nodes : &listed().leaves);
      if (is_near) near_root(of_a)[place] = k;
    }
  }

  // Tests all pairs of listed nodes; each lane takes one pair at a time.
  __device__ void put_near_pairs(std::uint32_t room) const {
    const TeamCounts near = listed();
    const std::uint32_t all = near.nodes * near.leaves;
    // Numbers are so small that the quotient in floats gives that of the integers.
    static_assert(kMostUpperNodes * kMostUpperNodes < 1U << 16);
    const float share = 1.0F / static_cast<float>(near.leaves);
    for (std::uint32_t first = team_.member * 32; first < all; first += team_.members * 32) {
      const bool exists = first + lane() < all;
      const std::uint32_t n = exists ? first + lane() : first;
      const auto row = static_cast<std::uint32_t>((static_cast<float>(n) + 0.5F) * share);
      const std::uint32_t a = near_root(true)[row];
      const std::uint32_t b = near_root(false)[n - row * near.leaves];
      const FetchedNode node_a = trees_.upper(true, a);
      const FetchedNode node_b = trees_.upper(false, b);
      const float gap2 = squared_gap(node_a.box, node_b.box);
      const unsigned found = __ballot_sync(kFullWarp, exists && trees_.is_near(gap2));
      if (found == 0) continue;
      const std::uint32_t place = place_in_warp(found, &pairs().nodes);
      if ((found >> lane() & 1U) != 0 && place < room) team_.nodes().put(place, {node_a.word, node_b.word, gap2});
    }
  }

  const TreePair& trees_;
  const SearchTeam& team_;
};

}  // namespace broadside::gpu
