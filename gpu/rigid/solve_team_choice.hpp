// How many blocks solve a step of turning bodies, and which barrier they use.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/rigid/rigid_view.hpp"

namespace broadside::gpu {

struct SolveTeamChoice {
  SolveTeamKind kind = SolveTeamKind::kGrid;
  std::uint32_t blocks = 1;
};

// Enough blocks for two threads a body. A heap of cubes has fewer patches than that, so most patches have a thread of
// their own, which loads its patch before the bodies are ready. A cluster has the fastest barrier; where it has too few
// threads, a grid is faster.
inline SolveTeamChoice choose_solve_team(const SolveShape& shape, std::uint32_t body_count, bool may_cluster) {
  constexpr std::uint64_t kThreadsOfBody = 2;
  const std::uint64_t threads = shape.grid.threads;
  const std::uint64_t wanted = (kThreadsOfBody * body_count + threads - 1) / threads;
  const bool is_cluster = may_cluster && shape.cluster_blocks > 1 && wanted <= shape.cluster_blocks;
  const std::uint64_t most = is_cluster ? shape.cluster_blocks : shape.grid.blocks;
  return {is_cluster ? SolveTeamKind::kCluster : SolveTeamKind::kGrid,
          static_cast<std::uint32_t>(std::min(std::bit_ceil(wanted), most))};
}

}  // namespace broadside::gpu
