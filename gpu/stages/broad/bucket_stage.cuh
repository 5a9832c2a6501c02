// Gives buckets their ranges of entries: a counting sort in which the chunks of buckets lie in no order.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// The place in `begin` of the word that says where a bucket's range starts: each chunk of buckets has one more word.
__device__ inline std::uint32_t bucket_place(std::uint32_t bucket) {
  return bucket + bucket / kBucketChunk;
}

// Gives every bucket its range of entries and clears the counts for the next frame. A warp takes several chunks. Chunks
// lie in the order in which warps come; buckets of a chunk follow each other. Several chunks share one atomic, because
// all atomics go to one word, which takes some 2 ns for each.
template <typename Team>
__device__ void place_buckets(const Team& team, std::uint32_t bucket_mask, std::uint32_t* count, std::uint32_t* begin,
                              unsigned long long* cursor) {
  constexpr std::uint32_t kChunks = 4;
  constexpr std::uint32_t kEach = kBucketChunk / 32;
  static_assert(kEach == 4, "one uint4 a lane");
  const std::uint64_t chunks = (std::uint64_t{bucket_mask} + 1) / kBucketChunk;
  for (std::uint64_t first = warp_rank(team) * kChunks; first < chunks; first += warp_count(team) * kChunks) {
    uint4 c[kChunks];
    std::uint32_t sum = 0;
#pragma unroll
    for (std::uint32_t k = 0; k < kChunks; ++k) {
      c[k] = uint4{0, 0, 0, 0};
      if (first + k >= chunks) continue;
      uint4* counts = reinterpret_cast<uint4*>(count + (first + k) * kBucketChunk) + lane();
      c[k] = *counts;
      *counts = uint4{0, 0, 0, 0};
      sum += c[k].x + c[k].y + c[k].z + c[k].w;
    }
    for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(kFullWarp, sum, step);
    unsigned long long base = 0;
    if (lane() == 0 && sum > 0) base = atomicAdd(cursor, static_cast<unsigned long long>(sum));
    auto before = static_cast<std::uint32_t>(__shfl_sync(kFullWarp, base, 0));
#pragma unroll
    for (std::uint32_t k = 0; k < kChunks; ++k) {
      if (first + k >= chunks) continue;
      const std::uint32_t own = c[k].x + c[k].y + c[k].z + c[k].w;
      std::uint32_t through = own;
      for (unsigned step = 1; step < 32; step *= 2) {
        const std::uint32_t other = __shfl_up_sync(kFullWarp, through, step);
        if (lane() >= step) through += other;
      }
      const std::uint32_t place = before + through - own;
      std::uint32_t* to = begin + (first + k) * (kBucketChunk + 1) + std::uint64_t{lane()} * kEach;
      to[0] = place;
      to[1] = place + c[k].x;
      to[2] = place + c[k].x + c[k].y;
      to[3] = place + c[k].x + c[k].y + c[k].z;
      if (lane() == 31) to[4] = before + through;
      before += __shfl_sync(kFullWarp, through, 31);
    }
  }
}

}  // namespace broadside::gpu
