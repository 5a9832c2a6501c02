// The paper's comparison: a uniform grid of cells, hashed. METHOD section 2, "Spatial hash". A body is entered in every
// cell that its closed box touches; bodies that share a cell are tested, and each pair is reported in one cell only,
// the lowest that both touch. A body that touches more than kMostHashCells is entered in none and tested against all.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/broad/bucket_stage.cuh"
#include "gpu/stages/broad/grid_stage.cuh"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

struct HashRange {
  CellCorner low;
  std::uint32_t width_x = 0;
  std::uint32_t width_y = 0;
  std::uint64_t cells = 0;  // kMostHashCells + 1 if there are more
};

// The cells that a box touches. Rounding and floor are monotone, so boxes that touch at a coordinate both have its
// cell.
__device__ inline HashRange hash_range(const HashView& h, const PackedBox& box) {
  const CellCorner low = cell_of(box.min, h.cells_per_m);
  const CellCorner high = cell_of(box.max, h.cells_per_m);
  const auto width = [](int from, int to) {
    // From the lowest cell to the highest there are 2^32 cells, and the difference plus one would wrap to 0.
    return min(static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from), 65535U) + 1U;
  };
  const std::uint32_t x = width(low.x, high.x);
  const std::uint32_t y = width(low.y, high.y);
  const std::uint64_t cells = std::uint64_t{x} * y * width(low.z, high.z);
  return {low, x, y, cells > kMostHashCells ? kMostHashCells + 1 : cells};
}

__device__ inline CellCorner hash_cell(const HashRange& r, std::uint32_t k) {
  return {r.low.x + static_cast<int>(k % r.width_x), r.low.y + static_cast<int>(k / r.width_x % r.width_y),
          r.low.z + static_cast<int>(k / r.width_x / r.width_y)};
}

__device__ inline std::uint32_t hash_bucket(const HashView& h, CellCorner c) {
  std::uint32_t v = static_cast<std::uint32_t>(c.x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(c.y) * 0x85EBCA6BU ^
                    static_cast<std::uint32_t>(c.z) * 0xC2B2AE35U;
  v = (v ^ v >> 15) * 0x2C1B3C6DU;
  return (v ^ v >> 16) & h.bucket_mask;
}

// A warp per body. It counts all entries even if there is no room for them, so that the host knows how much to make.
template <typename Team>
__device__ void hash_count(const Team& team, const HashView& h, const PackedBox* boxes, std::uint32_t body_count,
                           Counters* counters) {
  for (std::uint64_t i = warp_rank(team); i < body_count; i += warp_count(team)) {
    const HashRange range = hash_range(h, boxes[i]);
    if (range.cells > kMostHashCells) {
      if (lane() == 0) h.oversized[atomicAdd(&counters->oversized, 1U)] = static_cast<std::uint32_t>(i);
      continue;
    }
    if (lane() == 0) atomicAdd(&counters->entries, static_cast<unsigned long long>(range.cells));
    for (auto k = static_cast<std::uint32_t>(lane()); k < range.cells; k += 32)
      atomicAdd(&h.count[hash_bucket(h, hash_cell(range, k))], 1U);
  }
}

template <typename Team>
__device__ void hash_scatter(const Team& team, const HashView& h, const PackedBox* boxes, std::uint32_t body_count) {
  for (std::uint64_t i = warp_rank(team); i < body_count; i += warp_count(team)) {
    const HashRange range = hash_range(h, boxes[i]);
    if (range.cells > kMostHashCells) continue;
    for (auto k = static_cast<std::uint32_t>(lane()); k < range.cells; k += 32) {
      const CellCorner c = hash_cell(range, k);
      const std::uint32_t bucket = hash_bucket(h, c);
      const std::uint32_t place = h.begin[bucket_place(bucket)] + atomicAdd(&h.cursor[bucket], 1U);
      h.entries.items[place] = {c.x, c.y, c.z, static_cast<std::uint32_t>(i)};
    }
  }
}

__device__ inline bool is_pair_of_boxes(const PackedBox& a, const PackedBox& b) {
  return core::overlaps(unpack(a), unpack(b)) && (a.high_tag & b.high_tag) == 0;
}

// A thread per entry tests it against the entries of its cell; then oversized bodies are tested against all bodies.
template <typename Team, typename Work>
__device__ void hash_find(const Team& team, const HashView& h, const PackedBox* boxes, std::uint32_t body_count,
                          const Counters* counters, WarpQueue& queue, Work& work) {
  const std::uint64_t entries = counters->entries;
  for (std::uint64_t round = 0; round < (entries + team.size() - 1) / team.size(); ++round) {
    const std::uint64_t place = round * team.size() + team.rank();
    HashEntry own;
    PackedBox box;
    std::uint32_t k = 0;
    std::uint32_t end = 0;
    if (place < entries) {
      own = h.entries.items[place];
      box = boxes[own.body];
      const std::uint32_t at = bucket_place(hash_bucket(h, {own.x, own.y, own.z}));
      k = h.begin[at];
      end = h.begin[at + 1];
      work.node();
    }
    const CellCorner cell{own.x, own.y, own.z};
    const CellCorner low = cell_of(box.min, h.cells_per_m);
    for (; __any_sync(kFullWarp, k < end); ++k) {
      bool hit = false;
      HashEntry other;
      if (k < end) other = h.entries.items[k];
      if (k < end && other.body > own.body && CellCorner{other.x, other.y, other.z} == cell) {
        const PackedBox other_box = boxes[other.body];
        const CellCorner other_low = cell_of(other_box.min, h.cells_per_m);
        const CellCorner lowest{max(low.x, other_low.x), max(low.y, other_low.y), max(low.z, other_low.z)};
        work.tests(lowest == cell ? 1U : 0U);
        hit = lowest == cell && is_pair_of_boxes(box, other_box);
      }
      queue.push(hit, {own.body, other.body});
    }
  }
  const std::uint64_t tests = std::uint64_t{counters->oversized} * body_count;
  for (std::uint64_t round = 0; round < (tests + team.size() - 1) / team.size(); ++round) {
    const std::uint64_t test = round * team.size() + team.rank();
    bool hit = false;
    core::Pair pair;
    if (test < tests) {
      const std::uint32_t body = h.oversized[test / body_count];
      const auto other = static_cast<std::uint32_t>(test % body_count);
      const PackedBox other_box = boxes[other];
      const bool other_finds = other < body && hash_range(h, other_box).cells > kMostHashCells;
      work.tests(other != body && !other_finds ? 1U : 0U);
      hit = other != body && !other_finds && is_pair_of_boxes(boxes[body], other_box);
      pair = core::make_pair_of(body, other);
    }
    queue.push(hit, pair);
  }
}

template <typename Team>
__device__ void hash_clear(const Team& team, const HashView& h) {
  const std::uint64_t buckets = std::uint64_t{h.bucket_mask} + 1;
  for (std::uint64_t b = team.rank(); b < buckets; b += team.size()) h.count[b] = h.cursor[b] = 0;
}

}  // namespace broadside::gpu
