// The launch after a search in mapped coordinates. The search finds every pair, and some that overlap only in its
// coordinates. So each found pair is tested on the boxes as given, and kept if it overlaps and belongs to this pass.
#pragma once

#include "gpu/broad/settle_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

template <typename Team>
__device__ void settle_pairs(const Team& team, const SettleView& s, unsigned long long count, PairQueue& room) {
  WarpQueue queue(room, s.pairs, &s.counters->confirmed);
  const unsigned long long rounds = (count + team.size() - 1) / team.size();
  for (unsigned long long round = 0; round < rounds; ++round) {
    const unsigned long long k = round * team.size() + team.rank();
    bool is_kept = false;
    core::Pair pair{};
    if (k < count) {
      const core::Pair found = s.found.items[k];
      const PackedBox a = s.given[found.i];
      const PackedBox b = s.given[found.j];
      const std::uint32_t group = a.high_tag >> 1;
      is_kept = core::overlaps(unpack(a), unpack(b)) && (group != b.high_tag >> 1 || (s.owned >> group & 1U) != 0);
      pair = core::make_pair_of(a.low_tag, b.low_tag);
    }
    queue.push(is_kept, pair);
  }
  queue.flush();
}

// `shared`: a PairQueue for each warp. If the search had too little room, those of its pairs that were stored are
// settled anyway, so that the host learns how much room both lists need.
__device__ inline void run_settle(const SettleView& view, unsigned char* shared) {
  const GridTeam grid(view.barrier);
  PairQueue& room = reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32];
  settle_pairs(grid, view, min(view.counters->pairs, static_cast<unsigned long long>(view.found.capacity)), room);
  grid.sync();
  if (grid.rank() != 0) return;
  mark_end(grid, view.outcome, FindStep::kSearch);
  if (view.counters->confirmed > view.pairs.capacity) view.counters->is_aborted = 1;
  view.outcome->counters = *view.counters;
}

}  // namespace broadside::gpu
