// What all threads of a team bring together: the largest of their numbers, or a sum that no order shows in.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Four words in turns: after the barrier of one turn its word is read, the next one may be written by those who go on,
// and the one after is cleared, which nobody reads or writes before the next barrier.
class TeamSums {
 public:
  __device__ explicit TeamSums(RigidCounts* counts) : counts_(counts) {}

  // Of nonnegative numbers. By all threads; a barrier.
  template <typename Team>
  __device__ float largest(const Team& team, float own) {
    std::uint32_t word = __float_as_uint(own);
    for (unsigned step = 16; step > 0; step /= 2) word = max(word, __shfl_xor_sync(kFullWarp, word, step));
    if (lane() == 0 && word != 0) atomicMax(&counts_->largest[turn_ % 4], word);
    team.sync();
    word = load_fresh_if(true, &counts_->largest[turn_ % 4]);
    end_turn(team);
    return __uint_as_float(word);
  }

  // By all threads; a barrier.
  template <typename Team>
  __device__ std::uint64_t sum(const Team& team, std::uint64_t own) {
    unsigned long long units = own;
    for (unsigned step = 16; step > 0; step /= 2) units += __shfl_xor_sync(kFullWarp, units, step);
    if (lane() == 0 && units != 0) atomicAdd(&counts_->sums[turn_ % 4], units);
    team.sync();
    units = *static_cast<volatile unsigned long long*>(&counts_->sums[turn_ % 4]);
    end_turn(team);
    return units;
  }

 private:
  template <typename Team>
  __device__ void end_turn(const Team& team) {
    if (team.rank() == 0) {
      counts_->largest[(turn_ + 2) % 4] = 0;
      counts_->sums[(turn_ + 2) % 4] = 0;
    }
    ++turn_;
  }

  RigidCounts* counts_;
  std::uint32_t turn_ = 0;
};

}  // namespace broadside::gpu
