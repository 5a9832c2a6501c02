// Leftover work: a team that has searched a pair for some rounds leaves the rest to the whole grid, because most of the
// grid is idle by then.
#pragma once

#include "gpu/frame/divisor.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/leftover_work.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/small_counts.cuh"
#include "gpu/stages/vertices/search_stack.cuh"
#include "gpu/stages/vertices/tree_search.cuh"

namespace broadside::gpu {

// The most leftovers that one turn can have, so that each gets at least one block.
__device__ inline std::uint32_t most_leftovers() {
  return min(LeftoverView::kMost, gridDim.x);
}

// Hands over the work that a team has left for pair k after `rounds` rounds. If there is too much or too little to hand
// over, it tries again after as many rounds. The levels may reject the pair meanwhile: then the grid searches it in
// vain, which is fast, because its bodies are apart.
class LeftoverOfPair {
 public:
  // `to`: room for the leftovers of this turn. `before`: how many there were in earlier turns. `place`: a word of the
  // team's in shared memory.
  __device__ LeftoverOfPair(const FrameView& f, const LeftoverView& to, std::uint32_t before, const PlacedPair& bodies,
                            std::uint64_t k, std::uint32_t rounds, std::uint32_t* place)
      : f_(f),
        to_(to),
        before_(before),
        bodies_(bodies),
        k_(k),
        rounds_(rounds),
        asked_after_(rounds),
        place_(place),
        is_refused_(before >= SmallCounts::kMostLeftovers) {}

  __device__ bool is_asked_after(std::uint32_t round) {
    if (round != asked_after_) return false;
    asked_after_ += rounds_;
    return true;
  }

  // Called by all warps of the team. Returns whether the work was handed over: if so, the search ends.
  __device__ bool hand_over(const SearchTeam& team, const TeamCounts& left, float limit) {
    if (is_refused_ || left.nodes + left.leaves > LeftoverView::kEntries) return false;
    const bool is_first = team.member == 0 && lane() == 0;
    const std::uint32_t place = asked_place(team);
    is_refused_ = place >= most_leftovers();
    if (is_refused_) return false;
    for (std::uint32_t e = team.member * 32 + lane(); e < left.nodes + left.leaves; e += team.members * 32)
      to_.entries[place * LeftoverView::kEntries + e] = team.at(left, e);
    if (is_first) to_.items[place] = {bodies_, static_cast<std::uint32_t>(k_), limit, left.nodes, left.leaves};
    return true;
  }

 private:
  __device__ std::uint32_t asked_place(const SearchTeam& team) const {
    if (team.member == 0) {
      const unsigned long long tally = add_by_first_lane(f_.barrier, SmallCounts{0, 0, 1}.packed());
      if (lane() == 0) *place_ = SmallCounts::unpacked(tally).leftovers - before_;
    }
    team.sync();
    return *place_;
  }

  const FrameView& f_;
  const LeftoverView& to_;
  std::uint32_t before_;
  PlacedPair bodies_;
  std::uint64_t k_;
  std::uint32_t rounds_;
  std::uint32_t asked_after_;
  std::uint32_t* place_;
  bool is_refused_;
};

// For searches whose team does all of the work.
struct NoLeftover {
  __device__ static bool is_asked_after(std::uint32_t /*round*/) { return false; }
  __device__ static bool hand_over(const SearchTeam& /*team*/, const TeamCounts& /*left*/, float /*limit*/) {
    return false;
  }
};

// A block's part of one of `count` leftovers: every n-th entry, if n blocks share it. The order of entries is kept, so
// those that were added to the stack last come last here too.
class LeftoverPart {
 public:
  // Called by all threads of a block, which are the team; a barrier of the block must follow.
  __device__ LeftoverPart(const LeftoverView& leftovers, std::uint32_t count, const SearchTeam& team) {
    const FloatDivisor by_count(count);
    const std::uint32_t part = by_count.quotient(blockIdx.x);
    const std::uint32_t rank = blockIdx.x - part * count;
    const std::uint32_t parts = by_count.rounded_up(gridDim.x - rank);
    const FloatDivisor by_parts(parts);
    const auto up_to = [&](std::uint32_t end) { return end > part ? by_parts.rounded_up(end - part) : 0U; };
    const NodePair* entries = leftovers.entries + rank * LeftoverView::kEntries;
    leftover_ = fetched(leftovers.items + rank);
    // The first entries are loaded together with their count, so that the thread waits once.
    std::uint32_t k = threadIdx.x;
    NodePair entry;
    if (part + k * parts < LeftoverView::kEntries) entry = entries[part + k * parts];
    own_.nodes = up_to(leftover_.nodes);
    own_.leaves = up_to(leftover_.nodes + leftover_.leaves) - own_.nodes;
    while (k < own_.nodes + own_.leaves) {
      team.put(own_, k, entry);
      k += blockDim.x;
      if (part + k * parts < LeftoverView::kEntries) entry = entries[part + k * parts];
    }
  }

  __device__ const LeftoverSearch& leftover() const { return leftover_; }
  __device__ const TeamCounts& counts() const { return own_; }

 private:
  LeftoverSearch leftover_;
  TeamCounts own_;
};

// Writes `found` to the pair's result if it is nearer. Called by one thread of a block, while other blocks may do the
// same.
__device__ inline void improve(MeasuredPair* pair, const core::Proximity& found) {
  auto* word = reinterpret_cast<uint4*>(pair);
  uint4 seen = GridWords::load_whole(word);
  for (bool is_done = false; !is_done;) {
    const core::Proximity nearest{__uint_as_float(seen.x), seen.y, seen.z};
    is_done = !core::is_nearer(found, nearest) ||
              GridWords::replace_whole(
                  word, seen, {__float_as_uint(found.squared_distance_m2), found.vertex_a, found.vertex_b, seen.w});
  }
}

}  // namespace broadside::gpu
