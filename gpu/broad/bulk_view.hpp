// The views that kernels of bulk pairs get by value.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::gpu {

// Two corners, rounded: see bulk_cells.cuh.
struct CoarseBox {
  std::uint32_t min = 0;
  std::uint32_t max = 0;
};

// A box in its bucket.
struct alignas(16) BulkEntry {
  CoarseBox box;
  std::uint32_t body = 0;
  std::uint32_t tag = 0;  // see bulk_cells.cuh
};

// Runs of entries are read several at a time, also past their ends: this many entries behind the last one belong to no
// box.
constexpr std::uint32_t kEntriesBehind = 12;

// How many bins boxes go to: see bulk_bins.cuh.
struct BinsShape {
  std::uint32_t bins = 0;          // 0: there are too few boxes to need any
  std::uint32_t coarse_shift = 0;  // a coarse bin, to which boxes go first, is 2^coarse_shift bins; 0: none
  std::uint32_t bins_of_tile = 0;  // how many a block's tile counts at a time
  std::uint32_t shared_bytes = 0;  // shared memory of a block
  [[nodiscard]] BROADSIDE_HD std::uint32_t coarse_bins() const {
    return coarse_shift == 0 ? 0U : (bins >> coarse_shift) + 1U;
  }
};

// The arrays by which boxes are put in order, chunk of buckets by chunk, so that memory is written in runs.
struct BinsView {
  BinsShape shape;
  std::uint32_t* chunk_count = nullptr;    // [chunks]; zero between frames
  std::uint32_t* chunk_begin = nullptr;    // [chunks + 1] where their entries begin
  std::uint32_t* block_sum = nullptr;      // [blocks of the launch]
  std::uint32_t* first_chunk = nullptr;    // [bins]
  std::uint32_t* last_chunk = nullptr;     // [bins]
  std::uint32_t* cursor = nullptr;         // [bins] entries given out to blocks
  std::uint32_t* coarse_cursor = nullptr;  // [coarse bins] likewise
  std::uint32_t* whole_bucket = nullptr;   // [bodies] if there are coarse bins: the buckets of entries by coarse bin,
                                           // which lie in BulkView::entries until bins are made
  BulkEntry* entries = nullptr;            // [bodies] by bin
  std::uint16_t* bucket = nullptr;         // [bodies] buckets of these entries, counted within a group of chunks
};

struct BulkView {
  std::uint32_t bucket_mask = 0;    // buckets - 1; a power of two of buckets, whole chunks
  std::uint32_t axis_bits = 0;      // how many bits of y and of z go into a bucket unhashed
  std::uint32_t x_bits = 0;         // how many bits of x do
  std::uint32_t row_bits = 0;       // those of x_bits within which neighboring cells are neighboring buckets
  std::uint32_t levels_apart = 2;   // a power of two, as in BulkFit
  std::uint32_t x_halvings = 0;     // as there
  std::int32_t first_cell[3] = {};  // the cell of level 0 (before halving along x) that has the world's lower corner
  std::uint32_t* count = nullptr;   // [buckets]; zero between frames
  std::uint32_t* begin = nullptr;   // [bucket_words(buckets)]
  std::uint32_t* rank = nullptr;    // [bodies] place within the bucket
  BulkEntry* entries = nullptr;     // [bodies + kEntriesBehind] by bucket
  std::uint32_t* levels = nullptr;  // [2] bit k of the first: some body was on level k; of the second: see LevelMarks;
                                    // bits are only ever set
  std::uint32_t* turns = nullptr;   // [1] shares of the boxes given out to warps that look for their partners
  float cell_m = 0.0F;              // of level 0; level k has cells of cell_m / 2^k
  float cells_per_m = 0.0F;         // its inverse
  BinsView bins;
};

}  // namespace broadside::gpu
