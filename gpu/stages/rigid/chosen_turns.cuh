// Finds the few places of a large color that a sweep has to visit.
//
// While contacts bounce, a sweep visits the patches of stirred bodies: a few in a hundred. A lane has several places of
// a large color, one in each of its turns, and can pass over most of them; but in nearly every turn some lane of its
// warp has a patch to solve. So a warp first looks through several turns at once, and then solves the patches that it
// has chosen, 32 at a time.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/solve_team.cuh"

namespace broadside::gpu {

// For sweeps that never have to load a patch again: what was loaded ahead stays right.
struct NeverStale {
  template <typename Loaded>
  __device__ bool operator()(const Loaded& /*loaded*/) const {
    return false;
  }
};

// Which patches a sweep visits: those for which is_visited(slot) is true. It may be called for any place. pass(place)
// is called for the other places of large colors. is_stale(loaded): whether the patch has to be loaded again, because
// an earlier color of the sweep has changed what was loaded ahead. is_used: whether large colors are looked through
// first; the same for all threads.
template <typename IsVisited, typename Pass, typename IsStale>
struct Visits {
  bool is_used = false;
  IsVisited is_visited;
  Pass pass;
  IsStale is_stale;
};
template <typename IsVisited, typename Pass, typename IsStale>
Visits(bool, IsVisited, Pass, IsStale) -> Visits<IsVisited, Pass, IsStale>;

// The turns of this thread in one color after the other. By whole warps.
class ChosenTurns {
 public:
  __device__ explicit ChosenTurns(const SolveTeam& team) : team_(team) {}

  __device__ __forceinline__ void begin(std::uint32_t color) {
    scanned_ = team_.turn_in(color);
    color_ = color;
    has_more_ = true;
  }
  // Whether the warp has places of the color that it has not looked at.
  [[nodiscard]] __device__ bool has_more() const { return has_more_; }

  // Looks at the next places, and returns the first of what is chosen for this lane.
  template <typename Visits>
  __device__ __forceinline__ ColorTurn choose(const Visits& visits) {
    std::uint32_t* const chosen = team_.chosen();
    count_ = 0;
    __syncwarp();  // all lanes have read the places chosen before
    for (std::uint32_t turn = 0; turn < kTurns; turn += kTogether) {
      bool has[kTogether];
      bool is_chosen[kTogether];
      std::uint32_t place[kTogether];
      // is_visited is called for every turn, if need be for place 0, so that the loads of all turns are in flight
      // together.
#pragma unroll
      for (std::uint32_t k = 0; k < kTogether; ++k) {
        place[k] = scanned_.place + k * team_.threads();
        has[k] = scanned_.color == color_ && place[k] < scanned_.end;
        is_chosen[k] = visits.is_visited(team_.slot(has[k] ? place[k] : 0)) && has[k];
      }
#pragma unroll
      for (std::uint32_t k = 0; k < kTogether; ++k) {
        const unsigned with = __ballot_sync(kFullWarp, is_chosen[k]);
        if (is_chosen[k])
          chosen[count_ + static_cast<std::uint32_t>(__popc(with & ((1U << lane()) - 1U)))] = place[k];
        else if (has[k])
          visits.pass(place[k]);
        count_ += static_cast<std::uint32_t>(__popc(with));
      }
      if (scanned_.color == color_) scanned_.place += kTogether * team_.threads();
    }
    has_more_ = __any_sync(kFullWarp, scanned_.color == color_ && scanned_.place < scanned_.end) != 0;
    __syncwarp();
    at_ = lane();
    return own_turn();
  }
  [[nodiscard]] __device__ __forceinline__ ColorTurn next() {
    at_ += 32;
    return own_turn();
  }

 private:
  static constexpr std::uint32_t kTogether = 4;
  static constexpr std::uint32_t kTurns = SolveShared::kChosen / 32;
  static_assert(kTurns % kTogether == 0, "whole groups of turns fill the list");

  [[nodiscard]] __device__ ColorTurn own_turn() const {
    return at_ < count_ ? ColorTurn{color_, team_.chosen()[at_], 0} : ColorTurn{};
  }

  const SolveTeam& team_;
  ColorTurn scanned_;
  std::uint32_t color_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t at_ = 0;
  bool has_more_ = false;
};

}  // namespace broadside::gpu
