// What all threads of a team bring together: the largest of their numbers, or a sum that no order shows in.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// A turn: threads bring their numbers, by whole warps; a barrier of the team; all read what came together; all end the
// turn. Words are used in turns of four: after the barrier of one turn its words are read, those of the next may be
// written by threads that go on, and those of the one after are cleared, which nobody reads or writes before the next
// barrier.
class TeamSums {
 public:
  // Four numbers can be brought in one turn.
  enum Which : std::uint32_t { kFirst, kSecond, kThird, kFourth };

  __device__ explicit TeamSums(RigidCounts* counts) : counts_(counts) {}

  // Nonnegative numbers.
  __device__ void bring_largest(Which which, float own) const {
    const std::uint32_t word = warp_max(__float_as_uint(own));
    if (lane() == 0 && word != 0) atomicMax(&counts_->largest[turn_ % 4][which], word);
  }
  __device__ void bring_sum(unsigned long long units) const {
    for (unsigned step = 16; step > 0; step /= 2) units += __shfl_xor_sync(kFullWarp, units, step);
    if (lane() == 0 && units != 0) atomicAdd(&counts_->sums[turn_ % 4], units);
  }

  // Behind the barrier.
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
