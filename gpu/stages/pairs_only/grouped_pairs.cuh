// Finds bulk pairs by groups of neighboring boxes. This is for boxes that lie on surfaces in space: each has many
// others in the cells around it, but few partners, and a group of 32 of them has few groups near it.
#pragma once

#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/pairs_only/group_join.cuh"
#include "gpu/stages/pairs_only/group_order.cuh"

namespace broadside::gpu {

// Shared memory of a block: a JoinRoom for each warp, whose memory first holds the boxes of a cluster's groups, and the
// block's counts.
constexpr std::uint32_t grouped_shared_bytes(std::uint32_t threads) {
  return threads / 32 * static_cast<std::uint32_t>(sizeof(JoinRoom)) + static_cast<std::uint32_t>(sizeof(JoinCounts));
}
static_assert(sizeof(JoinRoom) >= kGroupSize * sizeof(PackedBox));

__device__ inline void run_grouped_pairs(const GroupedPairsView& view, unsigned char* shared) {
  const PairsView& search = view.search;
  const GroupView& g = view.grouping;
  const GridTeam grid(search.barrier);
  JoinRoom* rooms = reinterpret_cast<JoinRoom*>(shared);
  JoinRoom& room = rooms[threadIdx.x / 32];
  JoinCounts& counts = *reinterpret_cast<JoinCounts*>(rooms + blockDim.x / 32);
  mark_begin(grid, search.outcome);
  if (grid.rank() == 0) *search.counters = Counters{};
  count_cells(grid, g, search.boxes, search.box_count);
  grid.sync();
  mark_end(grid, search.outcome, FindStep::kCount);
  measure_chunks(grid, g);
  grid.sync();
  place_cells(g, reinterpret_cast<std::uint32_t*>(shared));
  grid.sync();
  mark_end(grid, search.outcome, FindStep::kPlace);
  fill_groups(grid, g, search.boxes, search.box_count);
  grid.sync();
  mark_end(grid, search.outcome, FindStep::kScatter);
  measure_groups(g, reinterpret_cast<PackedBox*>(shared));
  grid.sync();
  join_clusters(g, room, counts, &search.counters->group_pairs);
  grid.sync();
  const std::uint64_t group_pairs = *static_cast<volatile unsigned long long*>(&search.counters->group_pairs);
  const bool has_room = group_pairs <= g.group_pairs.capacity;
  if (has_room) join_groups(g, room, counts, group_pairs, search.pairs, &search.counters->pairs);
  grid.sync();
  if (grid.rank() != 0) return;
  mark_end(grid, search.outcome, FindStep::kSearch);
  search.counters->is_aborted = !has_room || search.counters->pairs > search.pairs.capacity ? 1 : 0;
  search.outcome->counters = *search.counters;
}

}  // namespace broadside::gpu
