// Which pairs touch, and in which order the contacts of each body are resolved. METHOD sections 3 and 5.
#pragma once

#include "core/method/coloring.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/vertices/narrow_pairs.cuh"

namespace broadside::gpu {

// The error E3 is that static bodies move, so in that variant they are written too.
__device__ inline bool is_written(const FrameView& f, std::uint32_t body) {
  return !is_static(f, body) || f.variant == core::Variant::kE3;
}

// Makes links of the touching pairs and counts each written body's contacts. Until list_contacts(), a link's ranks are
// its places among these contacts as they came.
template <typename Team>
__device__ void collect_touching(const Team& team, const FrameView& f, const NarrowPairs& pairs) {
  const std::uint64_t rounds = (pairs.count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = round * team.size() + team.rank();
    const NarrowPair narrow(f, pairs, k);
    const bool touches = narrow.touches(f);
    const unsigned long long place = warp_append_one(touches, &f.counters->touching);
    if (!touches) continue;
    const core::Pair p = narrow.pair();
    Link link{p.i, p.j, kNoRank, kNoRank};
    if (f.solver != Solver::kRacing) {
      if (is_written(f, p.i)) link.rank_i = atomicAdd(&f.degree[p.i], 1U);
      if (is_written(f, p.j)) link.rank_j = atomicAdd(&f.degree[p.j], 1U);
    }
    f.links[place] = link;
  }
}

// The key by which the colored solver orders contacts, or the Jacobi solver the terms of its sums.
__device__ inline unsigned long long order_key(const FrameView& f, const Link& link) {
  const core::Pair p{link.i, link.j};
  return f.solver == Solver::kJacobi ? core::pair_key(p) : core::color_priority(p);
}

__device__ inline std::uint32_t keys_before(const unsigned long long* keys, std::uint32_t count,
                                            unsigned long long key) {
  std::uint32_t before = 0;
#pragma unroll 4
  for (std::uint32_t k = 0; k < count; ++k) before += keys[k] < key ? 1U : 0U;
  return before;
}

// Whether body i's thread resolves a contact with these ranks. If only one body is written, its thread does; if both
// are, a hash of the ids chooses.
__device__ inline bool is_resolved_by_i(core::Pair p, std::uint32_t rank_i, std::uint32_t rank_j) {
  return rank_j == kNoRank || (rank_i != kNoRank && ((p.i * 0x9E3779B1U ^ p.j * 0x85EBCA6BU) >> 31) != 0);
}

// Makes each written body's list of its contacts, in their order. A contact's rank is the number of keys below its own,
// so nothing is sorted, and the result does not depend on the order in which pairs were found. kKeepsRanks: links get
// these ranks.
template <bool kKeepsRanks, typename Team>
__device__ void list_contacts(const Team& team, const FrameView& f, std::uint64_t count) {
  const std::uint64_t turns = (f.body_count + team.size() - 1) / team.size();
  for (std::uint64_t turn = 0; turn < turns; ++turn) {
    const std::uint64_t i = turn * team.size() + team.rank();
    const auto begin =
        static_cast<std::uint32_t>(warp_append(i < f.body_count ? f.degree[i] : 0U, &f.counters->listed));
    if (i < f.body_count) f.list_begin[i] = begin;
  }
  team.sync();
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const Link link = f.links[k];
    const unsigned long long key = order_key(f, link);
    if (link.rank_i != kNoRank) f.keys[f.list_begin[link.i] + link.rank_i] = key;
    if (link.rank_j != kNoRank) f.keys[f.list_begin[link.j] + link.rank_j] = key;
  }
  team.sync();
  for (std::uint64_t k = team.rank(); k < count; k += team.size()) {
    const Link link = f.links[k];
    const unsigned long long key = order_key(f, link);
    const auto rank_of = [&](std::uint32_t body, std::uint32_t place) {
      return place == kNoRank ? kNoRank : keys_before(f.keys + f.list_begin[body], f.degree[body], key);
    };
    const std::uint32_t rank_i = rank_of(link.i, link.rank_i);
    const std::uint32_t rank_j = rank_of(link.j, link.rank_j);
    if (kKeepsRanks) f.links[k] = {link.i, link.j, rank_i, rank_j};
    const bool by_i = is_resolved_by_i({link.i, link.j}, rank_i, rank_j);
    const auto enter = [&](std::uint32_t body, std::uint32_t rank, std::uint32_t other, std::uint32_t rank_other,
                           bool is_ours) {
      if (rank == kNoRank) return;
      f.lists[f.list_begin[body] + rank] = {static_cast<std::uint32_t>(k), other, rank_other,
                                            shape_of(f, other) | (is_ours ? ListEntry::kIsOurs : 0U)};
    };
    enter(link.i, rank_i, link.j, rank_j, by_i);
    enter(link.j, rank_j, link.i, rank_i, !by_i);
  }
  team.sync();
}

}  // namespace broadside::gpu
