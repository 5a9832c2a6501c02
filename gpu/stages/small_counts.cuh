// What a small frame counts in the tally of its barrier word.
#pragma once

#include <cstdint>

#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/grid_word.hpp"

namespace broadside::gpu {

// One addition to the tally reserves places in several lists, and after the barrier every block knows all counts.
struct SmallCounts {
  // Once this many teams have asked, no more do; the bits have room for those that ask at the same moment.
  static constexpr std::uint32_t kMostLeftovers = 1U << 13;

  std::uint32_t pairs = 0;
  std::uint32_t judged = 0;  // pairs whose levels were tested: the confirmed, if levels come first; else the rejected
  std::uint32_t leftovers = 0;  // how often teams asked for a place for leftover work

  // Pairs that the levels below 0 keep; 0 for flat levels.
  __device__ std::uint32_t confirmed(const SmallFrameView& f) const {
    return are_levels_left(f) ? pairs - judged : judged;
  }

  __device__ unsigned long long packed() const {
    return pairs | std::uint64_t{judged} << kPairBits | std::uint64_t{leftovers} << 2 * kPairBits;
  }
  // From the barrier word, or from its tally alone.
  __device__ static SmallCounts unpacked(unsigned long long word) {
    const unsigned long long tally = word & GridWord::kTally;
    return {static_cast<std::uint32_t>(tally) & kMostPairs, static_cast<std::uint32_t>(tally >> kPairBits) & kMostPairs,
            static_cast<std::uint32_t>(tally >> 2 * kPairBits)};
  }

 private:
  static constexpr std::uint32_t kPairBits = 17;
  static constexpr std::uint32_t kMostPairs = (1U << kPairBits) - 1;
  static_assert(kMostSmallBodies * (kMostSmallBodies - 1) / 2 <= kMostPairs &&
                GridWord::kTally >> 2 * kPairBits >= 2 * kMostLeftovers - 1);
};

}  // namespace broadside::gpu
