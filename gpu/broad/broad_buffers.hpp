// Device memory of a broad phase of any kind.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/box.hpp"
#include "core/result.hpp"
#include "core/variant.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/broad/bulk_fit.hpp"
#include "gpu/broad/bulk_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

// Which broad phase the user asked for.
enum class Broad { kTree, kOctree, kHash, kBrute };

// Below this many bodies the tree start tests all pairs of body boxes: 2,080 tiles of 32 x 32 are one tile a warp on a
// large GPU, and take less than the grid's three passes.
constexpr std::uint32_t kLeastBodiesForGrid = 2048;

// From this many boxes on a broad phase that runs alone searches by bulk_search.cuh, with a lane for each box.
constexpr std::uint32_t kLeastBoxesForBulk = 50000;
// From this many boxes on the entries of bulk pairs do not fit a cache, and go to bins first.
constexpr std::uint32_t kLeastBoxesForBins = 1000000;

// Worlds over all exponents are crowded on every level: from this many boxes on they are bulk pairs. 30,000 of them
// take 0.54 ms on an H100 by the search of fewer boxes, 0.44 ms as bulk pairs.
constexpr std::uint32_t kLeastBoxesOfExponentsForBulk = 20000;

// What is known of the boxes before the first frame.
struct BoxFacts {
  std::uint32_t count = 0;
  float largest_side_m = 0.0F;
  float coordinate_range_m = 0.0F;  // the largest magnitude of a coordinate
  core::Vec3 low_corner;            // about where the world begins
  std::uint64_t hash_entries = 0;   // for boxes of these sizes anywhere; a frame that needs more is repeated
  core::Box domain;                 // of the published scene octree
  BulkFit fit;                      // for bulk pairs alone
};

// How many cells a box with these sides can touch, wherever it is.
std::uint64_t hash_cells_of(core::Vec3 side_m, float cell_m);

// Whether no box is longer than the largest cell that a grid can have, 2^125 m. If a box is longer, its partners may
// lie in cells where no search looks for them: then all n (n - 1) / 2 pairs of boxes are tested in tiles instead.
bool fits_grid(const BoxFacts& facts);

// The number of buckets of a grid.
std::uint64_t grid_buckets(std::uint64_t bodies);
// The number of buckets of bulk pairs.
std::uint64_t bulk_buckets(const BoxFacts& facts);

class BroadBuffers {
 public:
  // `blocks`: how many the launch that sorts has.
  core::Status load(Start start, const BoxFacts& facts, float hash_cell_m, core::Variant variant,
                    const BinsShape& bins = {}, std::uint32_t blocks = 0);
  // Takes the facts that a new set of boxes may change.
  void refit(const BoxFacts& facts);
  // Makes room for what the aborted frame demanded.
  core::Status grow(const Counters& demanded);
  void fill(BroadView& view) const;
  // For Start::kBulk.
  void fill(BulkView& view) const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  core::Status reserve_buckets(std::uint64_t buckets, const char* what);
  core::Status load_bulk(const BoxFacts& facts, const BinsShape& bins, std::uint32_t blocks);

  BroadView view_;
  BulkView bulk_;
  DeviceBuffer<std::uint32_t> bucket_count_;
  DeviceBuffer<std::uint32_t> bucket_begin_;
  DeviceBuffer<std::uint32_t> bucket_cursor_;
  DeviceBuffer<std::uint32_t> rank_;
  DeviceBuffer<std::uint32_t> levels_;
  DeviceBuffer<PackedBox> entries_;
  DeviceBuffer<BulkEntry> bulk_entries_;
  DeviceBuffer<BulkEntry> binned_entries_;
  DeviceBuffer<std::uint16_t> binned_buckets_;
  DeviceBuffer<std::uint32_t> chunk_count_;
  DeviceBuffer<std::uint32_t> chunk_begin_;
  DeviceBuffer<std::uint32_t> whole_buckets_;
  DeviceBuffer<std::uint32_t> bins_;  // what BinsView has of each bin, and block_sum
  DeviceBuffer<HashEntry> hash_entries_;
  DeviceBuffer<std::uint32_t> oversized_;
  DeviceBuffer<std::uint32_t> node_count_;
  DeviceBuffer<std::uint32_t> node_begin_;
  DeviceBuffer<std::uint32_t> range_end_;
};

}  // namespace broadside::gpu
