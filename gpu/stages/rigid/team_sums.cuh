// Numbers to which all threads of a team contribute: a maximum, or a sum that does not depend on any order.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// A turn has four parts: threads contribute their numbers, by whole warps; a barrier of the team; all read the result;
// all end the turn. There are words for four turns. After the barrier of a turn its own words are read, those of the
// next turn may be written by threads that go on, and those of the turn after that are cleared; no thread reads or
// writes these before the next barrier.
class TeamSums {
 public:
  // Up to four numbers can be contributed in one turn.
  enum Which : std::uint32_t { kFirst, kSecond, kThird, kFourth };

  __device__ explicit TeamSums(RigidCounts* counts) : counts_(counts) {}

  // For nonnegative numbers.
  __device__ void bring_largest(Which which, float own) const {
    const std::uint32_t word = warp_max(__float_as_uint(own));
    if (lane() == 0 && word != 0) atomicMax(&counts_->largest[turn_ % 4][which], word);
  }
  __device__ void bring_sum(unsigned long long units) const {
    for (unsigned step = 16; step > 0; step /= 2) units += __shfl_xor_sync(kFullWarp, units, step);
    if (lane() == 0 && units != 0) atomicAdd(&counts_->sums[turn_ % 4], units);
  }

  // To be read after the barrier.
  [[nodiscard]] __device__ float largest(Which which) const {
    return __uint_as_float(load_fresh_if(true, &counts_->largest[turn_ % 4][which]));
  }
  [[nodiscard]] __device__ std::uint64_t sum() const {
    return *static_cast<volatile unsigned long long*>(&counts_->sums[turn_ % 4]);
  }

  template <typename Team>
  __device__ void end_turn(const Team& team) {
    if (team.rank() == 0) {
      for (std::uint32_t which = kFirst; which <= kFourth; ++which) counts_->largest[(turn_ + 2) % 4][which] = 0;
      counts_->sums[(turn_ + 2) % 4] = 0;
    }
    ++turn_;
  }

 private:
  RigidCounts* counts_;
  std::uint32_t turn_ = 0;
};

}  // namespace broadside::gpu
