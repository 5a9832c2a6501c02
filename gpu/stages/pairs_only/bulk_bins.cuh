// Sorts boxes of bulk pairs into their buckets, in two steps. If boxes come in no order, and there are more entries
// than the cache holds, every entry is written to another place in memory, which takes several times as long as writing
// a run of entries. So entries first go to bins, each of which is several chunks of buckets. That is done one tile of
// boxes at a time, so that a tile writes its share of a bin as a run. Then, bin by bin, entries go to their buckets; a
// bin is small enough for a multiprocessor's shared memory. In the end entries lie in the order of their buckets. From
// some 15 million boxes on there are more bins than a tile can count, and than a tile has entries: then entries go to
// coarse bins first.
#pragma once

#include <algorithm>

#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"
#include "gpu/stages/pairs_only/bulk_chunks.cuh"

namespace broadside::gpu {

// Entries of a bin in shared memory: its share of a tile's size, and what its last chunk has beyond that.
constexpr std::uint32_t kStagedPerThread = 11;

// Shared memory for a tile. `bucket_bytes`: the size of what a step stores for an entry's bucket.
constexpr std::uint32_t tile_bytes(std::uint32_t threads, std::uint32_t bins, std::uint32_t bucket_bytes) {
  return kBoxesPerThread * threads *
             (static_cast<std::uint32_t>(sizeof(BulkEntry) + 2 * sizeof(std::uint16_t)) + bucket_bytes) +
         (2 * bins + 1 + 32) * static_cast<std::uint32_t>(sizeof(std::uint32_t));
}
constexpr std::uint32_t bin_bytes(std::uint32_t threads) {
  return static_cast<std::uint32_t>(kStagedPerThread * threads * sizeof(BulkEntry) +
                                    (kGroupBuckets + 32) * sizeof(std::uint32_t));
}

// The bins for these boxes, for blocks of this many threads that may have `most_bytes` of shared memory; no bins if
// that is too little. `most_at_once`: the most bins that a tile counts, even if it could count more; 0: no such limit.
//
// Blocks count each tile's entries by bin in shared memory. If a tile can count all bins, boxes go to them in one step.
// If there are more bins, boxes go to coarse bins first; after that a tile has entries of few coarse bins, and can
// count the bins of these.
constexpr BinsShape bins_shape(std::uint32_t threads, std::uint32_t boxes, std::uint32_t buckets,
                               std::uint32_t most_bytes, std::uint32_t most_at_once) {
  BinsShape shape;
  shape.bins = bins_of(threads, boxes, buckets);
  shape.bins_of_tile = shape.bins;
  shape.shared_bytes = std::max(tile_bytes(threads, shape.bins, sizeof(std::uint16_t)), bin_bytes(threads));
  if (shape.shared_bytes <= most_bytes && (most_at_once == 0 || shape.bins <= most_at_once)) return shape;
  // There are about as many coarse bins as a coarse bin has bins, so that both steps write runs of about the same
  // length.
  while (shape.bins >> 2 * shape.coarse_shift != 0) ++shape.coarse_shift;
  // A tile seldom has entries of more than two coarse bins; if it does, it is gone through several times.
  const std::uint32_t of_two = 2U << shape.coarse_shift;
  shape.bins_of_tile = std::max(shape.coarse_bins(), most_at_once == 0 ? of_two : std::min(of_two, most_at_once));
  shape.shared_bytes = std::max(tile_bytes(threads, shape.bins_of_tile, sizeof(std::uint32_t)), bin_bytes(threads));
  return shape.shared_bytes <= most_bytes ? shape : BinsShape{};
}

// What differs between the three steps: where entries come from, into which bins they go, and where they are written.
struct BoxesToBins {
  using Bucket = std::uint16_t;
  using Item = PackedBox;
  static constexpr bool kIsByCoarseBin = false;
  const BulkView& g;
  const PackedBox* boxes;

  __device__ Item item(std::uint64_t k) const { return boxes[k]; }
  __device__ BulkPlace place(const Item& box, std::uint64_t k) const {
    return place_of(g, box, static_cast<std::uint32_t>(k));
  }
  __device__ std::uint32_t bin(std::uint32_t fine) const { return fine; }
  __device__ std::uint32_t* cursor() const { return g.bins.cursor; }
  __device__ static Bucket written(std::uint32_t bucket) { return static_cast<Bucket>(bucket % kGroupBuckets); }
  __device__ void write(std::uint32_t to, const BulkEntry& entry, Bucket bucket) const {
    g.bins.entries[to] = entry;
    g.bins.bucket[to] = bucket;
  }
};

struct BoxesToCoarseBins : BoxesToBins {
  using Bucket = std::uint32_t;
  __device__ std::uint32_t bin(std::uint32_t fine) const { return fine >> g.bins.shape.coarse_shift; }
  __device__ std::uint32_t* cursor() const { return g.bins.coarse_cursor; }
  __device__ static Bucket written(std::uint32_t bucket) { return bucket; }
  __device__ void write(std::uint32_t to, const BulkEntry& entry, Bucket bucket) const {
    g.entries[to] = entry;
    g.bins.whole_bucket[to] = bucket;
  }
};

struct CoarseBinsToBins : BoxesToBins {
  struct Item {
    BulkEntry entry;
    std::uint32_t bucket;
  };
  static constexpr bool kIsByCoarseBin = true;
  __device__ Item item(std::uint64_t k) const { return {g.entries[k], g.bins.whole_bucket[k]}; }
  __device__ BulkPlace place(const Item& item, std::uint64_t /*k*/) const { return {item.entry, item.bucket, {}, 0}; }
};

// The first and last bin that entries of a block's tile belong to. `room`: 2 words. Contains barriers of the block.
struct BinRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};
__device__ inline BinRange range_over_block(BinRange own, std::uint32_t* room) {
  if (threadIdx.x == 0) room[0] = ~0U, room[1] = 0;
  __syncthreads();
  const std::uint32_t first = warp_min(own.first);
  const std::uint32_t last = warp_max(own.last);
  if (lane() == 0) atomicMin(&room[0], first), atomicMax(&room[1], last);
  __syncthreads();
  const BinRange all{room[0], room[1]};
  __syncthreads();
  return all;
}

// Puts entries into bins, tile by tile.
template <typename Step>
__device__ void fill_bins(const BulkView& g, const Step& step, std::uint32_t count, unsigned char* shared) {
  using Bucket = typename Step::Bucket;
  const BinsView& b = g.bins;
  const std::uint32_t tile = kBoxesPerThread * blockDim.x;
  const std::uint32_t bins = b.shape.bins_of_tile;
  constexpr int kRankBits = 16;  // a tile's bin fits into the other bits
  constexpr std::uint32_t kElsewhere = ~0U;
  // Entries lie in the order of the boxes. The other arrays are in the order of the bins: which entry of the tile it
  // is, its bucket, its bin.
  auto* entries = reinterpret_cast<BulkEntry*>(shared);
  auto* written_bucket = reinterpret_cast<Bucket*>(entries + tile);
  auto* begin_of_bin = reinterpret_cast<std::uint32_t*>(written_bucket + tile);
  std::uint32_t* offset = begin_of_bin + bins + 1;  // what to add to a place in the tile to get that in memory
  std::uint32_t* room = offset + bins;
  auto* which = reinterpret_cast<std::uint16_t*>(room + 32);
  std::uint16_t* bin_at = which + tile;
  for (std::uint64_t first = std::uint64_t{blockIdx.x} * tile; first < count;
       first += std::uint64_t{gridDim.x} * tile) {
    const auto filled = static_cast<std::uint32_t>(min(std::uint64_t{tile}, count - first));
    std::uint32_t bucket[kBoxesPerThread];
    std::uint32_t bin[kBoxesPerThread];
#pragma unroll
    for (std::uint32_t half = 0; half < kBoxesPerThread; half += kBoxesAtOnce) {
      typename Step::Item item[kBoxesAtOnce];
#pragma unroll
      for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
        const std::uint32_t at = (half + k) * blockDim.x + threadIdx.x;
        if (at < filled) item[k] = step.item(first + at);
      }
#pragma unroll
      for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
        const std::uint32_t at = (half + k) * blockDim.x + threadIdx.x;
        bucket[half + k] = 0;
        if (at >= filled) continue;
        const BulkPlace to = step.place(item[k], first + at);
        entries[at] = to.entry;
        bucket[half + k] = to.bucket;
      }
    }
    BinRange range{Step::kIsByCoarseBin ? ~0U : 0U, 0};
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesPerThread; ++k) {
      bin[k] = step.bin(bin_of(bucket[k] / kBucketChunk, b.chunk_begin[bucket[k] / kBucketChunk]));
      if (!Step::kIsByCoarseBin || k * blockDim.x + threadIdx.x >= filled) continue;
      range.first = min(range.first, bin[k]);
      range.last = max(range.last, bin[k]);
    }
    if constexpr (Step::kIsByCoarseBin) range = range_over_block(range, room);
    for (std::uint32_t first_bin = range.first; first_bin <= range.last; first_bin += bins) {
      for (std::uint32_t k = threadIdx.x; k < bins; k += blockDim.x) begin_of_bin[k] = 0;
      __syncthreads();
      std::uint32_t bin_and_rank[kBoxesPerThread];
#pragma unroll
      for (std::uint32_t k = 0; k < kBoxesPerThread; ++k) {
        const std::uint32_t own = bin[k] - first_bin;
        bin_and_rank[k] = k * blockDim.x + threadIdx.x < filled && own < bins
                              ? own << kRankBits | atomicAdd(&begin_of_bin[own], 1U)
                              : kElsewhere;
      }
      __syncthreads();
      // Each thread takes some neighboring bins.
      const std::uint32_t each = (bins + blockDim.x - 1) / blockDim.x;
      const std::uint32_t from = min(threadIdx.x * each, bins);
      const std::uint32_t to = min(from + each, bins);
      std::uint32_t sum = 0;
      for (std::uint32_t k = from; k < to; ++k) sum += begin_of_bin[k];
      std::uint32_t begin = sum_before(sum, room);
      for (std::uint32_t k = from; k < to; ++k) {
        const std::uint32_t own = begin_of_bin[k];
        begin_of_bin[k] = begin;
        begin += own;
      }
      if (threadIdx.x == blockDim.x - 1) begin_of_bin[bins] = begin;
      __syncthreads();
      for (std::uint32_t k = threadIdx.x; k < bins; k += 4 * blockDim.x) {
        std::uint32_t given[4];
#pragma unroll
        for (std::uint32_t j = 0; j < 4; ++j) {
          const std::uint32_t at = k + j * blockDim.x;
          const std::uint32_t own = at < bins ? begin_of_bin[at + 1] - begin_of_bin[at] : 0U;
          given[j] = own != 0 ? atomicAdd(&step.cursor()[first_bin + at], own) : 0U;
        }
#pragma unroll
        for (std::uint32_t j = 0; j < 4; ++j)
          if (k + j * blockDim.x < bins) offset[k + j * blockDim.x] = given[j] - begin_of_bin[k + j * blockDim.x];
      }
#pragma unroll
      for (std::uint32_t k = 0; k < kBoxesPerThread; ++k) {
        if (bin_and_rank[k] == kElsewhere) continue;
        const std::uint32_t own = bin_and_rank[k] >> kRankBits;
        const std::uint32_t place = begin_of_bin[own] + (bin_and_rank[k] & ((1U << kRankBits) - 1U));
        which[place] = static_cast<std::uint16_t>(k * blockDim.x + threadIdx.x);
        written_bucket[place] = Step::written(bucket[k]);
        bin_at[place] = static_cast<std::uint16_t>(own);
      }
      __syncthreads();
      const std::uint32_t all = begin_of_bin[bins];
#pragma unroll 4
      for (std::uint32_t k = threadIdx.x; k < all; k += blockDim.x)
        step.write(k + offset[bin_at[k]], entries[which[k]], written_bucket[k]);
      __syncthreads();
    }
  }
}

// Gives every bucket of these chunks its range. `place` has the counts of the buckets before the call, and the begins
// of their ranges after it.
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
  // Each chunk's additional word.
  for (std::uint32_t k = threadIdx.x; k < chunks; k += blockDim.x)
    g.begin[bucket_place((first_chunk + k + 1) * kBucketChunk) - 1] = g.bins.chunk_begin[first_chunk + k + 1];
}

// Puts entries into buckets, bin by bin.
__device__ inline void empty_bins(const BulkView& g, unsigned char* shared) {
  const BinsView& b = g.bins;
  auto* staged = reinterpret_cast<BulkEntry*>(shared);
  auto* place = reinterpret_cast<std::uint32_t*>(staged + kStagedPerThread * blockDim.x);
  std::uint32_t* room = place + kGroupBuckets;
  for (std::uint32_t bin = blockIdx.x; bin < b.shape.bins; bin += gridDim.x) {
    const std::uint32_t first_chunk = b.first_chunk[bin];
    if (first_chunk == ~0U) continue;  // no chunk with entries belongs to this bin
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
    } else {  // a chunk has more entries than fit
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
