// The last stage of a search in mapped coordinates. What it found holds every pair, and some that only its coordinates
// have: each is tested on the boxes as given, and kept where this pass is the one that keeps it.
#pragma once

#include "gpu/broad/settle_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

template <typename Team>
__device__ void settle_pairs(const Team& team, const SettleView& s, const core::Pair* found, unsigned long long count,
                             PairQueue& room, unsigned long long* demanded) {
  WarpQueue queue(room, s.pairs, demanded);
  const unsigned long long rounds = (count + team.size() - 1) / team.size();
  for (unsigned long long round = 0; round < rounds; ++round) {
    const unsigned long long k = round * team.size() + team.rank();
    bool is_kept = false;
    core::Pair pair{};
    if (k < count) {
      const PackedBox a = s.given[found[k].i];
      const PackedBox b = s.given[found[k].j];
      const std::uint32_t group = a.high_tag >> 1;
      is_kept = core::overlaps(unpack(a), unpack(b)) && (group != b.high_tag >> 1 || (s.owned >> group & 1U) != 0);
      pair = core::make_pair_of(a.low_tag, b.low_tag);
    }
    queue.push(is_kept, pair);
  }
  queue.flush();
}

}  // namespace broadside::gpu
