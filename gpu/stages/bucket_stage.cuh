// Ranges of entries for buckets: what a counting sort needs where nobody needs the order of the buckets.
#pragma once

#include "gpu/broad_view.hpp"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Where the range of a bucket starts in `begin`: a chunk of buckets has one word more.
__device__ inline std::uint32_t bucket_place(std::uint32_t bucket) {
  return bucket + bucket / kBucketChunk;
}

// Gives every bucket its range of entries, a warp a chunk, and clears the counts for the next frame. Chunks come in
// whatever order warps are in; buckets of a chunk follow each other.
template <typename Team>
__device__ void place_buckets(const Team& team, std::uint32_t bucket_mask, std::uint32_t* count, std::uint32_t* begin,
                              unsigned long long* cursor) {
  constexpr std::uint32_t kEach = kBucketChunk / 32;
  const std::uint64_t chunks = (std::uint64_t{bucket_mask} + 1) / kBucketChunk;
  for (std::uint64_t chunk = warp_rank(team); chunk < chunks; chunk += warp_count(team)) {
    uint4* counts = reinterpret_cast<uint4*>(count + chunk * kBucketChunk) + lane();
    static_assert(kEach == 4, "one uint4 a lane");
    const uint4 c = *counts;
    *counts = uint4{0, 0, 0, 0};
    const auto place = static_cast<std::uint32_t>(warp_append(c.x + c.y + c.z + c.w, cursor));
    // A warp that gives out nothing gets no place; its ranges are empty wherever they are.
    std::uint32_t* to = begin + chunk * (kBucketChunk + 1) + std::uint64_t{lane()} * kEach;
    to[0] = place;
    to[1] = place + c.x;
    to[2] = place + c.x + c.y;
    to[3] = place + c.x + c.y + c.z;
    if (lane() == 31) to[4] = place + c.x + c.y + c.z + c.w;
  }
}

}  // namespace broadside::gpu
