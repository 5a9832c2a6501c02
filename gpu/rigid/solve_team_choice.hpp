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

// Blocks for as many threads as there are bodies: the first color of a heap has about a patch a body, the other colors
// have fewer, and more blocks have a slower barrier. A cluster has the fastest barrier, so it is still chosen where its
// threads must take some patches of a color one after the other.
inline SolveTeamChoice choose_solve_team(const SolveShape& shape, std::uint32_t body_count, bool may_cluster) {
  // With more turns than this of a cluster's threads a grid is faster, although its barrier takes longer.
  constexpr std::uint64_t kMostTurnsOfCluster = 2;
  const std::uint64_t threads = shape.grid.threads;
  const std::uint64_t wanted = (body_count + threads - 1) / threads;
  const bool is_cluster =
      may_cluster && shape.cluster_blocks > 1 && wanted <= kMostTurnsOfCluster * shape.cluster_blocks;
  const std::uint64_t most = is_cluster ? shape.cluster_blocks : shape.grid.blocks;
  return {is_cluster ? SolveTeamKind::kCluster : SolveTeamKind::kGrid,
          static_cast<std::uint32_t>(std::min(std::bit_ceil(wanted), most))};
}

}  // namespace broadside::gpu
