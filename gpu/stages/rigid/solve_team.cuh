// The threads that solve contacts: all of a launch, which is one cluster of blocks or a cooperative grid.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/solve_shared.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kNoColor = 0xFFFFFFFFU;

// A thread's next place.
struct ColorTurn {
  std::uint32_t color = kNoColor;
  std::uint32_t place = 0;
  std::uint32_t end = 0;  // of the color's places
};

// One class for both kinds of launch, because the sweeps take long to compile.
class SolveTeam : public GridPlaces {
 public:
  // By all threads. constraints: f.constraints; the caller may know their layout when it is compiled.
  __device__ SolveTeam(const RigidFrameView& f, const ConstraintMemory& constraints, SolveShared& shared)
      : f_(f),
        constraints_(constraints),
        shared_(shared),
        colors_(min(f.counts->colors, f.color_capacity)),  // an aborted frame may have more
        alone_from_(colors_),
        threads_(static_cast<std::uint32_t>(size())),
        kind_(f.solve_team),
        barrier_(f.barrier) {
    while (alone_from_ > 0 && f.color_count[alone_from_ - 1] <= blockDim.x) --alone_from_;
    for (std::uint32_t color = 0; color < alone_from_; ++color)
      if (f.color_count[color] > kTurnsToChooseFrom * threads_) chosen_until_ = color + 1;
    for (std::uint32_t color = threadIdx.x; color < min(colors_, ColorTable::kColors); color += blockDim.x)
      shared_.colors.of_color[color] = places_of_color(f, color, threads_of(color));
    __syncthreads();
  }

  [[nodiscard]] __device__ __forceinline__ TileSlot slot(std::uint64_t place) const { return {constraints_, place}; }
  [[nodiscard]] __device__ std::uint32_t colors() const { return colors_; }
  // From this color on each color has at most as many patches as the first block has threads, and that block solves
  // them alone. In a loose heap most colors are such.
  [[nodiscard]] __device__ std::uint32_t alone_from() const { return alone_from_; }
  // The last large color is the one before this. Colors before it are treated as large, too. In a large color a thread
  // has several turns.
  [[nodiscard]] __device__ std::uint32_t chosen_until() const { return chosen_until_; }
  [[nodiscard]] __device__ std::uint32_t* chosen() const { return shared_.chosen[threadIdx.x / 32]; }
  // How many threads solve a color that the first block does not solve alone.
  [[nodiscard]] __device__ std::uint32_t threads() const { return threads_; }

  // This thread's first place in this color or a later one. Every sweep gives the same places to the same threads.
  [[nodiscard]] __device__ __forceinline__ ColorTurn turn_from(std::uint32_t color) const {
    for (; color < colors_; ++color) {
      if (color >= alone_from_ && blockIdx.x != 0) break;
      if (const ColorTurn turn = turn_in(color); turn.color == color) return turn;
    }
    return {};
  }
  // This thread's first place in this color, if it has one.
  [[nodiscard]] __device__ __forceinline__ ColorTurn turn_in(std::uint32_t color) const {
    const std::uint32_t threads = threads_of(color);
    const ColorPlaces places =
        color < ColorTable::kColors ? shared_.colors.of_color[color] : places_of_color(f_, color, threads);
    const std::uint32_t rank = color >= alone_from_ ? threadIdx.x : static_cast<std::uint32_t>(spread_rank());
    const std::uint32_t behind = rank >= places.first_rank ? 0 : threads;
    const std::uint32_t place = places.begin + (rank + behind - places.first_rank);
    return place < places.end ? ColorTurn{color, place, places.end} : ColorTurn{};
  }
  [[nodiscard]] __device__ __forceinline__ ColorTurn turn_after(const ColorTurn& turn) const {
    const std::uint32_t place = turn.place + threads_of(turn.color);
    if (place < turn.end) return {turn.color, place, turn.end};
    return turn_from(turn.color + 1);
  }

  __device__ void sync() const {
    arrive();
    wait();
  }
  // The barrier in two parts. Between them a thread may read only what no other thread has written.
  __device__ void arrive() const {
    if (kind_ == SolveTeamKind::kCluster)
      ClusterBarrier::arrive();
    else
      barrier_.arrive();
  }
  __device__ void wait() const {
    if (kind_ == SolveTeamKind::kCluster)
      ClusterBarrier::wait();
    else
      barrier_.wait();
    ++waits_;
  }
  // The versions of velocities with which the present sweep and the next one begin (versions.cuh).
  [[nodiscard]] __device__ std::uint32_t version() const { return version_; }
  [[nodiscard]] __device__ std::uint32_t next_version() const { return version_ + colors_ + 1; }
  // By all threads.
  __device__ void end_version() const { version_ = next_version(); }
  // The version of the impulses that the present substep keeps. It is the one with which its relaxation begins.
  [[nodiscard]] __device__ std::uint32_t kept_version() const { return kept_version_; }
  __device__ void begin_keeping() const { kept_version_ = version_; }
  // How often this thread has waited.
  [[nodiscard]] __device__ std::uint32_t waits() const { return waits_; }

 private:
  // A guess: with one or two turns, loading patches ahead should be as fast as choosing them. Not measured by itself.
  static constexpr std::uint32_t kTurnsToChooseFrom = 2;

  [[nodiscard]] __device__ std::uint32_t threads_of(std::uint32_t color) const {
    return color < alone_from_ ? threads_ : blockDim.x;
  }

  const RigidFrameView& f_;
  ConstraintMemory constraints_;
  SolveShared& shared_;
  std::uint32_t colors_;
  std::uint32_t alone_from_;
  std::uint32_t chosen_until_ = 0;
  std::uint32_t threads_;
  SolveTeamKind kind_;
  mutable GridBarrier barrier_;
  mutable std::uint32_t waits_ = 0;
  mutable std::uint32_t version_ = 0;
  mutable std::uint32_t kept_version_ = 0;
};

}  // namespace broadside::gpu
