// Finds the bins of bulk pairs, and where chunks of buckets begin: see bulk_bins.cuh.
#pragma once

#include "gpu/stages/broad/bucket_stage.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"
#include "gpu/stages/pairs_only/bulk_sort.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kBoxesPerThread = 8;  // of a tile
constexpr std::uint32_t kGroupChunks = 64;    // a bin has some of these
constexpr std::uint32_t kGroupBuckets = kGroupChunks * kBucketChunk;
static_assert(kGroupBuckets <= 1U << 16, "BinsView::bucket");

// How many bins there are for blocks of this many threads. The chunks of a bin belong to one group of chunks, and begin
// in one share of the entries that is as large as a tile. The numbers of group and share both grow along the chunks, so
// their sum is a bin's number.
constexpr std::uint32_t bins_of(std::uint32_t threads, std::uint32_t boxes, std::uint32_t buckets) {
  return boxes / (kBoxesPerThread * threads) + buckets / kGroupBuckets + 1;
}
__device__ inline std::uint32_t bin_of(std::uint32_t chunk, std::uint32_t begin) {
  return begin / (kBoxesPerThread * blockDim.x) + chunk / kGroupChunks;
}

// The sum over the threads of the block that come before this one. `room`: 32 words. Contains barriers of the block.
__device__ inline std::uint32_t sum_before(std::uint32_t own, std::uint32_t* room) {
  std::uint32_t through = own;
  for (unsigned step = 1; step < 32; step *= 2) {
    const std::uint32_t other = __shfl_up_sync(kFullWarp, through, step);
    if (lane() >= step) through += other;
  }
  if (lane() == 31) room[threadIdx.x / 32] = through;
  __syncthreads();
  const std::uint32_t warps = blockDim.x / 32;
  std::uint32_t before = 0;
  for (std::uint32_t w = lane(); w < warps; w += 32) before += w < threadIdx.x / 32 ? room[w] : 0U;
  for (unsigned step = 16; step > 0; step /= 2) before += __shfl_xor_sync(kFullWarp, before, step);
  __syncthreads();
  return before + through - own;
}

// Counts the entries of each chunk.
template <typename Team>
__device__ void count_chunks(const Team& team, const BulkView& g, const PackedBox* boxes, std::uint32_t count) {
  const BinsView& b = g.bins;
  for (std::uint64_t k = team.rank(); k < b.shape.bins; k += team.size()) {
    b.first_chunk[k] = ~0U;
    b.last_chunk[k] = 0;
    b.cursor[k] = ~0U;
  }
  for (std::uint64_t k = team.rank(); k < b.shape.coarse_bins(); k += team.size()) b.coarse_cursor[k] = ~0U;
  for (std::uint64_t first = team.rank(); first < count; first += team.size() * kBoxesAtOnce) {
    PackedBox box[kBoxesAtOnce];
    LevelMarks marks;
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k)
      if (first + k * team.size() < count) box[k] = boxes[first + k * team.size()];
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
      if (first + k * team.size() >= count) break;
      const int level = bulk_level(g, unpack(box[k]));
      const TableCell cell = own_cell(g, unpack(box[k]), level);
      marks.add(g, cell, level);
      atomicAdd(&b.chunk_count[bucket_of(g, cell, level) / kBucketChunk], 1U);
    }
    marks.note(g);
  }
}

// Notes where the entries of a coarse bin begin. Neighboring chunks mostly belong to one coarse bin, so only the first
// of them, which begins first, uses an atomic. Called by whole warps.
__device__ inline void note_coarse_begin(const BinsView& b, std::uint32_t chunk, bool has_chunk, std::uint32_t begin) {
  const std::uint32_t coarse = bin_of(chunk, begin) >> b.shape.coarse_shift;
  const std::uint32_t previous = __shfl_up_sync(kFullWarp, coarse, 1);
  if (has_chunk && (lane() == 0 || previous != coarse)) atomicMin(&b.coarse_cursor[coarse], begin);
}

// Finds where each chunk begins, and which bins follow from that. Also writes the begins of the buckets of empty
// chunks, which no later step visits.
template <typename Team>
__device__ void place_chunks_in_order(const Team& team, const BulkView& g, std::uint32_t* room) {
  const BinsView& b = g.bins;
  const std::uint32_t chunks = (g.bucket_mask + 1) / kBucketChunk;
  const std::uint32_t each = (chunks + gridDim.x - 1) / gridDim.x;
  const std::uint32_t from = min(blockIdx.x * each, chunks);
  const std::uint32_t to = min(from + each, chunks);
  std::uint32_t sum = 0;
  for (std::uint32_t c = from + threadIdx.x; c < to; c += blockDim.x) sum += b.chunk_count[c];
  const std::uint32_t before_own = sum_before(sum, room);
  if (threadIdx.x == blockDim.x - 1) b.block_sum[blockIdx.x] = before_own + sum;
  team.sync();
  std::uint32_t earlier = 0;
  for (std::uint32_t k = threadIdx.x; k < blockIdx.x; k += blockDim.x) earlier += b.block_sum[k];
  const std::uint32_t earlier_before = sum_before(earlier, room);
  if (threadIdx.x == blockDim.x - 1) room[0] = earlier_before + earlier;
  __syncthreads();
  std::uint32_t begin = room[0];
  __syncthreads();
  for (std::uint32_t first = from; first < to; first += blockDim.x) {
    const std::uint32_t c = first + threadIdx.x;
    const std::uint32_t own = c < to ? b.chunk_count[c] : 0U;
    const std::uint32_t before = sum_before(own, room);
    if (threadIdx.x == blockDim.x - 1) room[0] = before + own;
    if (c < to) {
      b.chunk_begin[c] = begin + before;
      b.chunk_count[c] = 0;
      if (own != 0) {
        const std::uint32_t bin = bin_of(c, begin + before);
        atomicMin(&b.first_chunk[bin], c);
        atomicMax(&b.last_chunk[bin], c);
        atomicMin(&b.cursor[bin], begin + before);
      }
      if (c + 1 == chunks) b.chunk_begin[chunks] = begin + before + own;
    }
    if (b.shape.coarse_shift != 0) note_coarse_begin(b, c, c < to, begin + before);
    for (unsigned empty = __ballot_sync(kFullWarp, c < to && own == 0); empty != 0; empty &= empty - 1U) {
      const std::uint32_t which = static_cast<std::uint32_t>(__ffs(static_cast<int>(empty))) - 1;
      const std::uint32_t value = __shfl_sync(kFullWarp, begin + before, which);
      std::uint32_t* words = g.begin + std::uint64_t{first + threadIdx.x / 32 * 32 + which} * (kBucketChunk + 1);
      for (std::uint32_t k = lane(); k <= kBucketChunk; k += 32) words[k] = value;
    }
    __syncthreads();
    begin += room[0];
    __syncthreads();
  }
}

}  // namespace broadside::gpu
