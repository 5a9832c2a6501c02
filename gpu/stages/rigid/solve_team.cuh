// The threads that solve contacts: all of a launch, which is one cluster of blocks or a cooperative grid.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// One class for both, because the sweeps are long to compile.
class SolveTeam : public GridPlaces {
 public:
  __device__ SolveTeam(SolveTeamKind kind, unsigned long long* barrier) : kind_(kind), barrier_(barrier) {}

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
  SolveTeamKind kind_;
  mutable GridBarrier barrier_;
};

}  // namespace broadside::gpu
