// Sorts boxes of bulk pairs into their buckets, in two steps. Boxes that come in no order and more entries than the
// cache holds make every entry a write somewhere else in memory, which takes it several times as long as a run of them.
// So entries go to bins first, each some chunks of buckets, a tile of boxes at a time, so that a tile's share of a bin
// is a run; then bin by bin, each small enough for a multiprocessor's shared memory, into their buckets. Entries end up
// in the order of their buckets.
#pragma once

#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"
#include "gpu/stages/pairs_only/bulk_chunks.cuh"

namespace broadside::gpu {

// Of a bin, in shared memory: its share and what the last of its chunks has beyond.
constexpr std::uint32_t kStagedPerThread = 11;

// Of shared memory.
constexpr std::uint32_t tile_bytes(std::uint32_t threads, std::uint32_t bins) {
  return kBoxesPerThread * threads * (sizeof(BulkEntry) + 3 * sizeof(std::uint16_t)) +
         (2 * bins + 1 + 32) * sizeof(std::uint32_t);
}
constexpr std::uint32_t bin_bytes(std::uint32_t threads) {
  return kStagedPerThread * threads * sizeof(BulkEntry) + (kGroupBuckets + 32) * sizeof(std::uint32_t);
}

// Tile by tile: entries into bins.
__device__ inline void fill_bins(const BulkView& g, const PackedBox* boxes, std::uint32_t count,
                                 unsigned char* shared) {
  const BinsView& b = g.bins;
  const std::uint32_t tile = kBoxesPerThread * blockDim.x;
  constexpr int kRankBits = 16;  // beside which a bin fits
  // By their place among the boxes: entries. By bin: which box it is, its bucket, its bin.
  auto* entries = reinterpret_cast<BulkEntry*>(shared);
  auto* begin_of_bin = reinterpret_cast<std::uint32_t*>(entries + tile);
  std::uint32_t* offset = begin_of_bin + b.bins + 1;  // from a place in the tile to that in memory
  std::uint32_t* room = offset + b.bins;
  auto* which = reinterpret_cast<std::uint16_t*>(room + 32);
  std::uint16_t* bucket_in_group = which + tile;
  std::uint16_t* bin_at = bucket_in_group + tile;
  for (std::uint64_t first = std::uint64_t{blockIdx.x} * tile; first < count;
       first += std::uint64_t{gridDim.x} * tile) {
    const auto filled = static_cast<std::uint32_t>(min(std::uint64_t{tile}, count - first));
    for (std::uint32_t k = threadIdx.x; k < b.bins; k += blockDim.x) begin_of_bin[k] = 0;
    __syncthreads();
    std::uint32_t bucket[kBoxesPerThread];
    std::uint32_t bin_and_rank[kBoxesPerThread];
#pragma unroll
    for (std::uint32_t half = 0; half < kBoxesPerThread; half += kBoxesAtOnce) {
      PackedBox box[kBoxesAtOnce];
#pragma unroll
      for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
        const std::uint32_t at = (half + k) * blockDim.x + threadIdx.x;
        if (at < filled) box[k] = boxes[first + at];
      }
#pragma unroll
      for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
        const std::uint32_t at = (half + k) * blockDim.x + threadIdx.x;
        bucket[half + k] = 0;
        if (at >= filled) continue;
        const BulkPlace to = place_of(g, box[k], static_cast<std::uint32_t>(first + at));
        entries[at] = to.entry;
        bucket[half + k] = to.bucket;
      }
    }
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesPerThread; ++k)
      bin_and_rank[k] = bin_of(bucket[k] / kBucketChunk, b.chunk_begin[bucket[k] / kBucketChunk]);
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesPerThread; ++k)
      if (k * blockDim.x + threadIdx.x < filled)
        bin_and_rank[k] = bin_and_rank[k] << kRankBits | atomicAdd(&begin_of_bin[bin_and_rank[k]], 1U);
    __syncthreads();
    // Each thread some neighboring bins.
    const std::uint32_t each = (b.bins + blockDim.x - 1) / blockDim.x;
    const std::uint32_t from = min(threadIdx.x * each, b.bins);
    const std::uint32_t to = min(from + each, b.bins);
    std::uint32_t sum = 0;
    for (std::uint32_t k = from; k < to; ++k) sum += begin_of_bin[k];
    std::uint32_t begin = sum_before(sum, room);
    for (std::uint32_t k = from; k < to; ++k) {
      const std::uint32_t own = begin_of_bin[k];
      begin_of_bin[k] = begin;
      begin += own;
    }
    if (threadIdx.x == 0) begin_of_bin[b.bins] = filled;
    __syncthreads();
    for (std::uint32_t k = threadIdx.x; k < b.bins; k += 4 * blockDim.x) {
      std::uint32_t given[4];
#pragma unroll
      for (std::uint32_t j = 0; j < 4; ++j) {
        const std::uint32_t bin = k + j * blockDim.x;
        const std::uint32_t own = bin < b.bins ? begin_of_bin[bin + 1] - begin_of_bin[bin] : 0U;
        given[j] = own != 0 ? atomicAdd(&b.cursor[bin], own) : 0U;
      }
#pragma unroll
      for (std::uint32_t j = 0; j < 4; ++j)
        if (k + j * blockDim.x < b.bins) offset[k + j * blockDim.x] = given[j] - begin_of_bin[k + j * blockDim.x];
    }
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesPerThread; ++k) {
      const std::uint32_t at = k * blockDim.x + threadIdx.x;
      if (at >= filled) break;
      const std::uint32_t bin = bin_and_rank[k] >> kRankBits;
      const std::uint32_t place = begin_of_bin[bin] + (bin_and_rank[k] & ((1U << kRankBits) - 1U));
      which[place] = static_cast<std::uint16_t>(at);
      bucket_in_group[place] = static_cast<std::uint16_t>(bucket[k] % kGroupBuckets);
      bin_at[place] = static_cast<std::uint16_t>(bin);
    }
    __syncthreads();
#pragma unroll 4
    for (std::uint32_t k = threadIdx.x; k < filled; k += blockDim.x) {
      const std::uint32_t to_place = k + offset[bin_at[k]];
      b.entries[to_place] = entries[which[k]];
      b.bucket[to_place] = bucket_in_group[k];
    }
    __syncthreads();
  }
}

// Gives every bucket of these chunks its range; `place`: counts before, where the ranges begin after.
__device__ inline void place_in_bin(const BulkView& g, std::uint32_t first_chunk, std::uint32_t chunks,
                                    std::uint32_t begin, std::uint32_t* place, std::uint32_t* room) {
  constexpr std::uint32_t kMostEach = 8;
  const std::uint32_t buckets = chunks * kBucketChunk;
  std::uint32_t at = begin;
  for (std::uint32_t first = 0; first < buckets; first += kMostEach * blockDim.x) {
    const std::uint32_t from = first + threadIdx.x * kMostEach;
    std::uint32_t sum = 0;
    for (std::uint32_t k = from; k < min(from + kMostEach, buckets); ++k) sum += place[k];
    const std::uint32_t before = sum_before(sum, room);
    if (threadIdx.x == blockDim.x - 1) room[0] = before + sum;
    std::uint32_t own_at = at + before;
    for (std::uint32_t k = from; k < min(from + kMostEach, buckets); ++k) {
      const std::uint32_t own = place[k];
      place[k] = own_at;
      own_at += own;
    }
    __syncthreads();
    at += room[0];
    __syncthreads();
  }
  for (std::uint32_t k = threadIdx.x; k < buckets; k += blockDim.x)
    g.begin[bucket_place(first_chunk * kBucketChunk + k)] = place[k];
  // The word more of each chunk.
  for (std::uint32_t k = threadIdx.x; k < chunks; k += blockDim.x)
    g.begin[bucket_place((first_chunk + k + 1) * kBucketChunk) - 1] = g.bins.chunk_begin[first_chunk + k + 1];
}

// Bin by bin: entries into buckets.
__device__ inline void empty_bins(const BulkView& g, unsigned char* shared) {
  const BinsView& b = g.bins;
  auto* staged = reinterpret_cast<BulkEntry*>(shared);
  auto* place = reinterpret_cast<std::uint32_t*>(staged + kStagedPerThread * blockDim.x);
  std::uint32_t* room = place + kGroupBuckets;
  for (std::uint32_t bin = blockIdx.x; bin < b.bins; bin += gridDim.x) {
    const std::uint32_t first_chunk = b.first_chunk[bin];
    if (first_chunk == ~0U) continue;  // of a group's empty chunks, or of a share in which no chunk begins
    const std::uint32_t chunks = b.last_chunk[bin] + 1 - first_chunk;
    const std::uint32_t begin = b.chunk_begin[first_chunk];
    const std::uint32_t count = b.chunk_begin[first_chunk + chunks] - begin;
    const std::uint32_t first_bucket = first_chunk % kGroupChunks * kBucketChunk;
    for (std::uint32_t k = threadIdx.x; k < chunks * kBucketChunk; k += blockDim.x) place[k] = 0;
    __syncthreads();
    if (count <= kStagedPerThread * blockDim.x) {
      constexpr int kBucketBits = 16;
      std::uint32_t bucket_and_rank[kStagedPerThread];
#pragma unroll
      for (std::uint32_t k = 0; k < kStagedPerThread; ++k) {
        const std::uint32_t e = k * blockDim.x + threadIdx.x;
        bucket_and_rank[k] = e < count ? b.bucket[begin + e] - first_bucket : 0U;
      }
#pragma unroll
      for (std::uint32_t k = 0; k < kStagedPerThread; ++k)
        if (k * blockDim.x + threadIdx.x < count)
          bucket_and_rank[k] |= atomicAdd(&place[bucket_and_rank[k]], 1U) << kBucketBits;
      __syncthreads();
      place_in_bin(g, first_chunk, chunks, begin, place, room);
#pragma unroll
      for (std::uint32_t k = 0; k < kStagedPerThread; ++k) {
        const std::uint32_t e = k * blockDim.x + threadIdx.x;
        if (e >= count) continue;
        const std::uint32_t rank = bucket_and_rank[k] >> kBucketBits;
        staged[place[bucket_and_rank[k] & ((1U << kBucketBits) - 1U)] + rank - begin] = b.entries[begin + e];
      }
      __syncthreads();
      for (std::uint32_t k = threadIdx.x; k < count; k += blockDim.x) g.entries[begin + k] = staged[k];
    } else {  // one chunk has more than fits
      for (std::uint32_t e = threadIdx.x; e < count; e += blockDim.x)
        atomicAdd(&place[b.bucket[begin + e] - first_bucket], 1U);
      __syncthreads();
      place_in_bin(g, first_chunk, chunks, begin, place, room);
      __syncthreads();
      for (std::uint32_t e = threadIdx.x; e < count; e += blockDim.x)
        g.entries[atomicAdd(&place[b.bucket[begin + e] - first_bucket], 1U)] = b.entries[begin + e];
    }
    __syncthreads();
  }
}

}  // namespace broadside::gpu
