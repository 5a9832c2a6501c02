// Puts boxes in order along a Morton curve, so that neighbors follow each other, and in groups of 32: a counting sort
// by cells. The choice of cells affects only the time that the search takes.
#pragma once

#include "gpu/broad/grouped_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Moves bit k to bit 3 k, for the lowest ten bits.
__device__ inline std::uint32_t every_third_bit(std::uint32_t v) {
  v = (v | v << 16) & 0x030000FFU;
  v = (v | v << 8) & 0x0300F00FU;
  v = (v | v << 4) & 0x030C30C3U;
  return (v | v << 2) & 0x09249249U;
}

__device__ inline std::uint32_t morton_cell(const GroupView& g, const core::Box& box) {
  const core::Vec3 center = core::center(box);
  const auto last = static_cast<float>((1U << g.axis_bits) - 1U);
  const auto index = [&](float v, float from) {
    return static_cast<std::uint32_t>(fminf(fmaxf((v - from) * g.cells_per_m, 0.0F), last));
  };
  return every_third_bit(index(center.x, g.corner.x)) | every_third_bit(index(center.y, g.corner.y)) << 1 |
         every_third_bit(index(center.z, g.corner.z)) << 2;
}

// Counts boxes into cells. The place within a cell depends on the order of the threads.
template <typename Team>
__device__ void count_cells(const Team& team, const GroupView& g, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t i = team.rank(); i < count; i += team.size())
    g.rank[i] = atomicAdd(&g.count[morton_cell(g, unpack(boxes[i]))], 1U);
}

__device__ inline std::uint32_t warp_sum(std::uint32_t v) {
#pragma unroll
  for (unsigned step = 16; step > 0; step /= 2) v += __shfl_xor_sync(kFullWarp, v, step);
  return v;
}

// The counts of a lane's four cells of a chunk.
__device__ inline uint4* counts_of_lane(const GroupView& g, std::uint64_t chunk) {
  return reinterpret_cast<uint4*>(g.count + chunk * kBucketChunk) + lane();
}

// Finds how many entries each chunk needs, with a warp for each chunk.
template <typename Team>
__device__ void measure_chunks(const Team& team, const GroupView& g) {
  for (std::uint64_t chunk = team.spread_rank() / 32; chunk < g.chunks(); chunk += warp_count(team)) {
    const uint4 c = *counts_of_lane(g, chunk);
    const std::uint32_t boxes = warp_sum(c.x + c.y + c.z + c.w);
    if (lane() == 0) g.chunk_room[chunk] = (boxes + kGroupSize - 1) / kGroupSize * kGroupSize;
  }
}

// Sum of these words over the whole block; `shared` has a word for each warp.
__device__ inline std::uint32_t block_sum(std::uint32_t v, std::uint32_t* shared) {
  const std::uint32_t own = warp_sum(v);
  if (lane() == 0) shared[threadIdx.x / 32] = own;
  __syncthreads();
  std::uint32_t sum = 0;
  for (std::uint32_t k = 0; k < blockDim.x / 32; ++k) sum += shared[k];
  return sum;
}

// Gives the cells of a chunk their ranges of entries, fills up the chunk with empty boxes, and clears the counts for
// the next search.
__device__ inline void place_chunk(const GroupView& g, std::uint32_t chunk, std::uint32_t before) {
  uint4* counts = counts_of_lane(g, chunk);
  const uint4 c = *counts;
  *counts = uint4{0, 0, 0, 0};
  const std::uint32_t own = c.x + c.y + c.z + c.w;
  std::uint32_t through = own;
#pragma unroll
  for (unsigned step = 1; step < 32; step *= 2) {
    const std::uint32_t other = __shfl_up_sync(kFullWarp, through, step);
    if (lane() >= step) through += other;
  }
  const std::uint32_t first = before + through - own;
  reinterpret_cast<uint4*>(g.begin + std::uint64_t{chunk} * kBucketChunk)[lane()] =
      uint4{first, first + c.x, first + c.x + c.y, first + c.x + c.y + c.z};
  const std::uint32_t boxes = __shfl_sync(kFullWarp, through, 31);
  const std::uint32_t room = g.chunk_room[chunk];
  for (std::uint32_t k = boxes + lane(); k < room; k += 32) g.entries[before + k] = pack(core::empty_box(), 0, 1);
  if (chunk == g.chunks() - 1 && lane() == 0) *g.entry_count = before + room;
}

// A block takes some consecutive chunks, a warp one of them at a time. `shared` has a word for each warp.
__device__ inline void place_cells(const GroupView& g, std::uint32_t* shared) {
  const std::uint32_t chunks = g.chunks();
  const std::uint32_t each = (chunks + gridDim.x - 1) / gridDim.x;
  const std::uint32_t first = min(blockIdx.x * each, chunks);
  const std::uint32_t end = min(first + each, chunks);
  std::uint32_t own = 0;
  for (std::uint32_t k = threadIdx.x; k < first; k += blockDim.x) own += g.chunk_room[k];
  const std::uint32_t before_block = block_sum(own, shared);
  for (std::uint32_t chunk = first + threadIdx.x / 32; chunk < end; chunk += blockDim.x / 32) {
    std::uint32_t in_block = 0;
    for (std::uint32_t k = first + lane(); k < chunk; k += 32) in_block += g.chunk_room[k];
    place_chunk(g, chunk, before_block + warp_sum(in_block));
  }
}

template <typename Team>
__device__ void fill_groups(const Team& team, const GroupView& g, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t i = team.rank(); i < count; i += team.size()) {
    const PackedBox box = boxes[i];
    g.entries[g.begin[morton_cell(g, unpack(box))] + g.rank[i]] = box;
  }
}

// The box around the boxes of all lanes. It counts as static if all of them are.
__device__ inline PackedBox around_warp(const PackedBox& own, std::uint32_t low_tag) {
  core::Box all = unpack(own);
#pragma unroll
  for (unsigned step = 16; step > 0; step /= 2) {
    core::Box other;
#pragma unroll
    for (int k = 0; k < 3; ++k) {
      other.min[k] = __shfl_xor_sync(kFullWarp, all.min[k], step);
      other.max[k] = __shfl_xor_sync(kFullWarp, all.max[k], step);
      all.min[k] = fminf(all.min[k], other.min[k]);
      all.max[k] = fmaxf(all.max[k], other.max[k]);
    }
  }
  return pack(all, low_tag, __ballot_sync(kFullWarp, own.high_tag != 0) == kFullWarp ? 1U : 0U);
}

// A block takes a cluster, a warp a group. `shared` has a box for each group of the cluster.
__device__ inline void measure_groups(const GroupView& g, PackedBox* shared) {
  const std::uint32_t groups = *g.entry_count / kGroupSize;
  for (std::uint32_t cluster = blockIdx.x; cluster * kGroupSize < groups; cluster += gridDim.x) {
    for (std::uint32_t k = threadIdx.x / 32; k < kGroupSize; k += blockDim.x / 32) {
      const std::uint32_t group = cluster * kGroupSize + k;
      PackedBox around = pack(core::empty_box(), 0, 1);
      if (group < groups) around = around_warp(g.entries[std::uint64_t{group} * kGroupSize + lane()], group);
      if (lane() != 0) continue;
      shared[k] = around;
      if (group < groups) g.groups[group] = around;
    }
    __syncthreads();
    if (threadIdx.x < 32) {
      const PackedBox around = around_warp(shared[lane()], cluster);
      if (lane() == 0) g.clusters[cluster] = around;
    }
    __syncthreads();
  }
}

}  // namespace broadside::gpu
