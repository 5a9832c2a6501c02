// Finds pairs level by level: overlapping clusters give pairs of groups, overlapping groups give pairs of boxes. A warp
// takes two groups, and each lane a member of each. Members that do not reach into the box that the groups have in
// common are in no pair. The others are few, so several of one group are tested against all of the other at once.
#pragma once

#include "gpu/broad/grouped_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// One warp's data in shared memory.
struct JoinRoom {
  PairQueue queue;
  PackedBox a[kGroupSize];
  PackedBox b[kGroupSize];
};

// A block's counts in shared memory.
struct JoinCounts {
  std::uint32_t next;       // the first piece of work that is not taken yet
  std::uint32_t pairs;      // how many pairs are in the warps' queues
  unsigned long long base;  // their place in the list of pairs
};

__device__ inline core::Box common_box(const core::Box& a, const core::Box& b) {
  core::Box common;
  for (int k = 0; k < 3; ++k) {
    common.min[k] = fmaxf(a.min[k], b.min[k]);
    common.max[k] = fminf(a.max[k], b.max[k]);
  }
  return common;
}

__device__ inline bool is_pair_of(const PackedBox& a, const PackedBox& b) {
  return (a.high_tag & b.high_tag) == 0 && core::overlaps(unpack(a), unpack(b));
}

// Every call is by the whole warp. Pairs name members by their low_tag; two static members are no pair.
class GroupJoin {
 public:
  __device__ GroupJoin(JoinRoom& room, AppendView<core::Pair> out, unsigned long long* demanded)
      : room_(room), queue_(room.queue, out, demanded) {}

  // Finds the pairs of members of two groups.
  __device__ void join(const PackedBox& a, const PackedBox& b, const core::Box& common) {
    const std::uint32_t count_a = keep(core::overlaps(unpack(a), common), a, room_.a);
    const std::uint32_t count_b = keep(core::overlaps(unpack(b), common), b, room_.b);
    __syncwarp();
    if (count_a != 0 && count_b != 0) {
      // A lane keeps one member of the larger side while it is tested against members of the smaller side.
      if (count_a <= count_b)
        hold(room_.a, count_a, room_.b, count_b);
      else
        hold(room_.b, count_b, room_.a, count_a);
    }
    __syncwarp();
  }

  // Finds the pairs within one group: on the ring of its members, each is paired with those on the half that follows
  // it.
  __device__ void join_itself(const PackedBox& a) {
    const std::uint32_t count = keep(!core::is_empty(unpack(a)), a, room_.a);
    __syncwarp();
    const PackedBox own = room_.a[min(lane(), count - 1)];
    for (std::uint32_t step = 1; step * 2 <= count; ++step) {
      const std::uint32_t other = lane() + step < count ? lane() + step : lane() + step - count;
      const bool is_mine = lane() < (step * 2 == count ? step : count);
      const PackedBox box = room_.a[is_mine ? other : 0];
      queue_.push(is_mine && is_pair_of(own, box), core::make_pair_of(own.low_tag, box.low_tag));
    }
    __syncwarp();
  }

  __device__ void push(bool is_pair, core::Pair pair) { queue_.push(is_pair, pair); }
  __device__ WarpQueue& queue() { return queue_; }

 private:
  // Puts the members of the lanes with `is_kept` into consecutive places; returns how many there are.
  __device__ std::uint32_t keep(bool is_kept, const PackedBox& member, PackedBox* to) {
    const unsigned kept = __ballot_sync(kFullWarp, is_kept);
    if (is_kept) to[__popc(kept & ((1U << lane()) - 1U))] = member;
    return static_cast<std::uint32_t>(__popc(kept));
  }

  // 2^width_bits lanes have one of the many each, and the warp tests them against as many of the few at once as it has
  // lanes for.
  __device__ void hold(const PackedBox* few, std::uint32_t few_count, const PackedBox* many, std::uint32_t many_count) {
    const std::uint32_t width_bits = many_count < 2 ? 0U : 32U - static_cast<std::uint32_t>(__clz(many_count - 1));
    const std::uint32_t column = lane() & ((1U << width_bits) - 1U);
    const PackedBox own = many[min(column, many_count - 1)];
    for (std::uint32_t first = 0; first < few_count; first += 32U >> width_bits) {
      const std::uint32_t row = first + (lane() >> width_bits);
      const PackedBox box = few[min(row, few_count - 1)];
      const bool is_pair = row < few_count && column < many_count && is_pair_of(own, box);
      queue_.push(is_pair, core::make_pair_of(own.low_tag, box.low_tag));
    }
  }

  JoinRoom& room_;
  WarpQueue queue_;
};

// A block's share of the work: every n-th piece of n blocks, because neighboring pieces are alike. The block's warps
// take pieces when they are free, because pieces differ.
class BlockShare {
 public:
  // Called by all threads of the block.
  __device__ BlockShare(JoinCounts& counts, std::uint64_t pieces) : counts_(counts) {
    count_ = static_cast<std::uint32_t>((pieces + gridDim.x - 1 - blockIdx.x) / gridDim.x);
    if (threadIdx.x == 0) counts.next = counts.pairs = 0;
    __syncthreads();
  }
  // Called by the whole warp. Takes `want` pieces, or as many as are left, and returns how many; lane k gets the k-th
  // of them in `piece`.
  __device__ std::uint32_t take(std::uint32_t want, std::uint64_t& piece) {
    const std::uint32_t next = room_for_warp(want, &counts_.next);
    if (next >= count_) return 0;
    const std::uint32_t taken = min(want, count_ - next);
    piece = std::uint64_t{next + min(lane(), taken - 1)} * gridDim.x + blockIdx.x;
    return taken;
  }

 private:
  JoinCounts& counts_;
  std::uint32_t count_ = 0;
};

constexpr std::uint32_t kPiecesAtOnce = 4;

// Takes every two clusters: on the ring of all clusters, each with itself and with those on the half that follows it.
__device__ inline void join_clusters(const GroupView& g, JoinRoom& room, JoinCounts& counts,
                                     unsigned long long* demanded) {
  const std::uint32_t groups = *g.entry_count / kGroupSize;
  const std::uint32_t clusters = (groups + kGroupSize - 1) / kGroupSize;
  const auto member = [&](std::uint32_t cluster) {
    const std::uint32_t group = cluster * kGroupSize + lane();
    return group < groups ? g.groups[group] : pack(core::empty_box(), 0, 1);
  };
  GroupJoin join(room, g.group_pairs, demanded);
  const std::uint64_t pieces = std::uint64_t{clusters} * (clusters / 2 + 1);
  // If pieces are very many, most are clusters that do not overlap.
  const std::uint32_t want = pieces > std::uint64_t{gridDim.x} * blockDim.x * 32 ? 32U : kPiecesAtOnce;
  BlockShare share(counts, pieces);
  std::uint64_t piece = 0;
  while (const std::uint32_t taken = share.take(want, piece)) {
    const std::uint32_t p = static_cast<std::uint32_t>(piece) % clusters;
    const std::uint32_t step = static_cast<std::uint32_t>(piece) / clusters;
    const std::uint32_t q = p + step < clusters ? p + step : p + step - clusters;
    const PackedBox of_p = g.clusters[p];
    const PackedBox of_q = g.clusters[q];
    const bool has_been = step * 2 == clusters && p >= step;  // taken the other way around
    const core::Box common = common_box(unpack(of_p), unpack(of_q));
    unsigned left = __ballot_sync(kFullWarp, lane() < taken && !has_been && is_pair_of(of_p, of_q));
    for (; left != 0; left &= left - 1) {
      const auto from = static_cast<unsigned>(__ffs(left)) - 1U;
      const std::uint32_t own_p = __shfl_sync(kFullWarp, p, from);
      const std::uint32_t own_q = __shfl_sync(kFullWarp, q, from);
      core::Box own_common;
      for (int axis = 0; axis < 3; ++axis) {
        own_common.min[axis] = __shfl_sync(kFullWarp, common.min[axis], from);
        own_common.max[axis] = __shfl_sync(kFullWarp, common.max[axis], from);
      }
      const PackedBox a = member(own_p);
      if (own_p != own_q) {
        join.join(a, member(own_q), own_common);
      } else {
        join.push(a.high_tag == 0, {a.low_tag, a.low_tag});
        join.join_itself(a);
      }
    }
  }
  join.queue().flush_block(counts.pairs, counts.base);
}

__device__ inline void join_groups(const GroupView& g, JoinRoom& room, JoinCounts& counts, std::uint64_t group_pairs,
                                   AppendView<core::Pair> out, unsigned long long* demanded) {
  GroupJoin join(room, out, demanded);
  BlockShare share(counts, group_pairs);
  std::uint64_t piece = 0;
  while (const std::uint32_t taken = share.take(kPiecesAtOnce, piece)) {
    const core::Pair own = g.group_pairs.items[piece];
    for (std::uint32_t k = 0; k < taken; ++k) {
      const std::uint32_t p = __shfl_sync(kFullWarp, own.i, k);
      const std::uint32_t q = __shfl_sync(kFullWarp, own.j, k);
      const PackedBox a = g.entries[std::uint64_t{p} * kGroupSize + lane()];
      if (p == q) {
        join.join_itself(a);
        continue;
      }
      const PackedBox b = g.entries[std::uint64_t{q} * kGroupSize + lane()];
      const PackedBox of_p = g.groups[p];
      const PackedBox of_q = g.groups[q];
      group_loads();
      join.join(a, b, common_box(unpack(of_p), unpack(of_q)));
    }
  }
  join.queue().flush_block(counts.pairs, counts.base);
}

}  // namespace broadside::gpu
