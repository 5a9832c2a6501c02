// Long searches of few pairs: what is left of one when its team has worked at it for some rounds is shared by the whole
// grid, most of which has nothing else to do.
#pragma once

#include "gpu/frame/divisor.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/search_rest.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/small_counts.cuh"
#include "gpu/stages/vertices/search_stack.cuh"
#include "gpu/stages/vertices/tree_search.cuh"

namespace broadside::gpu {

// So many rests there can be: each of them has a block of its own, or more.
__device__ inline std::uint32_t most_rests() {
  return min(RestsView::kMost, gridDim.x);
}

// What a team that searches pair k may do with what is left: hand it over. `rounds`: how long it has lasted then, and
// again after as many. The pair may be rejected by its levels meanwhile, and is searched for nothing
// then: bodies so far apart are soon done.
class RestOfPair {
 public:
  // `to`: where those of this time go, before which there were so many. `is_marked`: pair k's place there is its own;
  // otherwise one is asked for. `place`: of the team, in shared memory.
  __device__ RestOfPair(const FrameView& f, const RestsView& to, bool is_marked, std::uint32_t before,
                        const PlacedPair& bodies, std::uint64_t k, std::uint32_t rounds, std::uint32_t* place)
      : f_(f),
        to_(to),
        is_marked_(is_marked),
        before_(before),
        bodies_(bodies),
        k_(k),
        rounds_(rounds),
        asked_after_(rounds),
        place_(place),
        is_refused_(before >= SmallCounts::kMostRests) {}

  __device__ bool is_asked_after(std::uint32_t round) {
    if (round != asked_after_) return false;
    asked_after_ += rounds_;
    return true;
  }

  // By all warps of the team; true: the search ends.
  __device__ bool hand_over(const SearchTeam& team, const TeamCounts& left, float limit) {
    if (is_refused_ || left.nodes + left.leaves > RestsView::kEntries) return false;
    const bool is_first = team.member == 0 && lane() == 0;
    auto place = static_cast<std::uint32_t>(k_);
    if (is_marked_) {
      if (is_first) set_bits(f_.barrier + 1, 1ULL << k_);
    } else {
      place = asked_place(team);
      is_refused_ = place >= most_rests();
      if (is_refused_) return false;
    }
    for (std::uint32_t e = team.member * 32 + lane(); e < left.nodes + left.leaves; e += team.members * 32)
      to_.entries[place * RestsView::kEntries + e] = team.at(left, e);
    if (is_first) to_.items[place] = {bodies_, static_cast<std::uint32_t>(k_), limit, left.nodes, left.leaves};
    return true;
  }

 private:
  __device__ std::uint32_t asked_place(const SearchTeam& team) const {
    if (team.member == 0) {
      const unsigned long long tally = add_by_first_lane(f_.barrier, SmallCounts{0, 0, 1}.packed());
      if (lane() == 0) *place_ = SmallCounts::unpacked(tally).rests - before_;
    }
    team.sync();
    return *place_;
  }

  const FrameView& f_;
  const RestsView& to_;
  bool is_marked_;
  std::uint32_t before_;
  PlacedPair bodies_;
  std::uint64_t k_;
  std::uint32_t rounds_;
  std::uint32_t asked_after_;
  std::uint32_t* place_;
  bool is_refused_;
};

// Of searches that end where they began.
struct NoRest {
  __device__ static bool is_asked_after(std::uint32_t /*round*/) { return false; }
  __device__ static bool hand_over(const SearchTeam& /*team*/, const TeamCounts& /*left*/, float /*limit*/) {
    return false;
  }
};

// A block's part of one of so many rests: every so-manieth entry, those that were opened last at the end.
class RestPart {
 public:
  // By all threads of a block, which are the team; a barrier of the block must follow. `marked`: the places of the
  // rests, or 0: the first ones.
  __device__ RestPart(const RestsView& rests, std::uint32_t count, unsigned long long marked, const SearchTeam& team) {
    const FloatDivisor by_count(count);
    const std::uint32_t part = by_count.quotient(blockIdx.x);
    const std::uint32_t rank = blockIdx.x - part * count;
    const std::uint32_t parts = by_count.rounded_up(gridDim.x - rank);
    const std::uint32_t place = marked != 0 ? bit_of_rank(marked, rank) : rank;
    const FloatDivisor by_parts(parts);
    const auto up_to = [&](std::uint32_t end) { return end > part ? by_parts.rounded_up(end - part) : 0U; };
    const NodePair* entries = rests.entries + place * RestsView::kEntries;
    rest_ = fetched(rests.items + place);
    // The first are asked for before it is known how many there are: one wait.
    std::uint32_t k = threadIdx.x;
    NodePair entry;
    if (part + k * parts < RestsView::kEntries) entry = entries[part + k * parts];
    own_.nodes = up_to(rest_.nodes);
    own_.leaves = up_to(rest_.nodes + rest_.leaves) - own_.nodes;
    while (k < own_.nodes + own_.leaves) {
      team.put(own_, k, entry);
      k += blockDim.x;
      if (part + k * parts < RestsView::kEntries) entry = entries[part + k * parts];
    }
  }

  __device__ const SearchRest& rest() const { return rest_; }
  __device__ const TeamCounts& counts() const { return own_; }

 private:
  // The bit that has so many set ones below it. By whole warps.
  __device__ static std::uint32_t bit_of_rank(unsigned long long bits, std::uint32_t rank) {
    const auto low = static_cast<std::uint32_t>(bits);
    const auto high = static_cast<std::uint32_t>(bits >> 32U);
    const unsigned below = (1U << lane()) - 1U;
    const auto ours = [&](std::uint32_t half, std::uint32_t before) {
      return __ballot_sync(kFullWarp, (half >> lane() & 1U) != 0 && before + __popc(half & below) == rank);
    };
    const unsigned in_low = ours(low, 0);
    const unsigned in_high = ours(high, __popc(low));
    return in_low != 0 ? __ffs(static_cast<int>(in_low)) - 1 : 31 + __ffs(static_cast<int>(in_high));
  }

  SearchRest rest_;
  TeamCounts own_;
};

// By one thread, of a pair for which others may find something at the same time. `had_none`: its team had found nothing
// when it handed over; then the word is not asked for first, as it is most likely still as it was.
__device__ inline void improve(MeasuredPair* pair, const core::Proximity& found, bool had_none) {
  auto* word = reinterpret_cast<uint4*>(pair);
  constexpr core::Proximity kNone;
  uint4 seen{__float_as_uint(kNone.squared_distance_m2), kNone.vertex_a, kNone.vertex_b, 0};
  if (!had_none) seen = GridWords::load_whole(word);
  for (bool is_done = false; !is_done;) {
    const core::Proximity nearest{__uint_as_float(seen.x), seen.y, seen.z};
    is_done = !core::is_nearer(found, nearest) ||
              GridWords::replace_whole(
                  word, seen, {__float_as_uint(found.squared_distance_m2), found.vertex_a, found.vertex_b, seen.w});
  }
}

}  // namespace broadside::gpu
