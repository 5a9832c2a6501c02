// The threads that solve contacts: all of a launch, which is one cluster of blocks or a cooperative grid.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// One class for both, because the sweeps are long to compile.
class SolveTeam : public GridPlaces {
 public:
  __device__ explicit SolveTeam(const RigidFrameView& f)
      : colors_(min(f.counts->colors, f.color_capacity)),  // an aborted frame may have more
        alone_from_(colors_),
        kind_(f.solve_team),
        barrier_(f.barrier) {
    while (alone_from_ > 0 && f.color_count[alone_from_ - 1] <= blockDim.x) --alone_from_;
  }

  [[nodiscard]] __device__ std::uint32_t colors() const { return colors_; }
  // The last colors, from this one on, have a patch for each thread of the first block or fewer: it solves them alone.
  // Most colors of a loose heap are such.
  [[nodiscard]] __device__ std::uint32_t alone_from() const { return alone_from_; }

  __device__ void sync() const {
    sync([] {});
  }
  // meanwhile(): between arriving at the barrier and waiting for the others. What it reads, no other thread has
  // written.
  template <typename Work>
  __device__ __forceinline__ void sync(const Work& meanwhile) const {
    if (kind_ == SolveTeamKind::kCluster)
      ClusterBarrier::arrive();
    else
      barrier_.arrive();
    meanwhile();
    if (kind_ == SolveTeamKind::kCluster)
      ClusterBarrier::wait();
    else
      barrier_.wait();
  }

 private:
  std::uint32_t colors_;
  std::uint32_t alone_from_;
  SolveTeamKind kind_;
  mutable GridBarrier barrier_;
};

}  // namespace broadside::gpu
