#include "gpu/broad/broad_buffers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>

#include "core/method/scene_octree.hpp"

namespace broadside::gpu {
namespace {

// Buckets of the grid, before rounding up to a power of two: a lookup is a run of some three of them.
constexpr std::uint64_t kBucketsPerFiveBodies = 8;
constexpr std::uint64_t kLeastBuckets = 1024;
constexpr std::uint64_t kMostBuckets = 1ULL << 31U;

constexpr float kSlack = 1.0F + 0x1p-10F;
// So large that its inverse is still a normal number.
constexpr float kMostCell_m = 0x1p125F;

// The size of the largest cells. A box may grow by a few units in the last place when it is placed, so a cell must be
// many units in the last place of the coordinates long, whatever it holds. The search of bulk pairs allows for that
// rounding (bulk_search.cuh), so its largest cell may be as small as the smallest cell of any box: 2^-18 of the
// coordinates, see bulk_level.
float largest_cell_m(Start start, const BoxFacts& facts) {
  const float least_share = start == Start::kBulk ? 0x1p-18F : 0x1p-17F;
  // So large that a cell that is halved twenty times, and its inverse, are still normal numbers.
  constexpr float kLeast = 0x1p-100F;
  const float wanted =
      std::max({facts.largest_side_m * kSlack * facts.fit.cell_scale, facts.coordinate_range_m * least_share, kLeast});
  return std::min(wanted, kMostCell_m);
}

// The most bits for each axis that fit beside the 5 bits of a row, which are bits of x too.
std::uint32_t axis_bits(std::uint64_t buckets) {
  const auto all = static_cast<std::uint32_t>(std::bit_width(buckets)) - 1U;
  std::uint32_t bits = 1;
  while (std::max(bits + 1, 5U) + 2 * (bits + 1) <= all) ++bits;
  return bits;
}

}  // namespace

std::uint64_t grid_buckets(std::uint64_t bodies) {
  return std::bit_ceil(std::max(kBucketsPerFiveBodies * bodies / 5, kLeastBuckets));
}

std::uint64_t bulk_buckets(const BoxFacts& facts) {
  return grid_buckets(facts.count) << facts.fit.x_halvings;
}

bool fits_grid(const BoxFacts& facts) {
  return facts.largest_side_m * kSlack <= kMostCell_m;
}

std::uint64_t hash_cells_of(core::Vec3 side_m, float cell_m) {
  double cells = 1.0;
  for (int axis = 0; axis < 3; ++axis) cells *= std::floor(static_cast<double>(side_m[axis] / cell_m)) + 2.0;
  return cells > static_cast<double>(kMostHashCells) ? kMostHashCells : static_cast<std::uint64_t>(cells);
}

core::Status BroadBuffers::reserve_buckets(std::uint64_t buckets, const char* what) {
  BROADSIDE_TRY(bucket_count_.reserve(buckets, what));
  BROADSIDE_TRY(bucket_begin_.reserve(bucket_words(buckets), what));
  return bucket_count_.fill_bytes(0);
}

core::Status BroadBuffers::load_bulk(const BoxFacts& facts, const BinsShape& bins, std::uint32_t blocks) {
  BulkView& bulk = bulk_;
  const std::size_t n = facts.count;
  const std::uint64_t buckets = bulk_buckets(facts);
  BROADSIDE_TRY(bulk_entries_.reserve(n + kEntriesBehind, "boxes"));
  BROADSIDE_TRY(levels_.reserve(3, "boxes"));
  BROADSIDE_TRY(levels_.fill_bytes(0));
  bulk.bucket_mask = static_cast<std::uint32_t>(buckets - 1);
  bulk.axis_bits = axis_bits(grid_buckets(n));
  bulk.x_bits = static_cast<std::uint32_t>(std::bit_width(buckets)) - 1U - 2 * bulk.axis_bits;
  bulk.row_bits = std::min(bulk.x_bits, static_cast<std::uint32_t>(std::bit_width(kBucketChunk)) - 1U);
  bulk.bins.shape = bins;
  if (bins.bins == 0) {
    BROADSIDE_TRY(rank_.reserve(n, "boxes"));
    return reserve_buckets(buckets, "boxes");
  }
  BROADSIDE_TRY(bucket_begin_.reserve(bucket_words(buckets), "boxes"));
  BROADSIDE_TRY(binned_entries_.reserve(n, "boxes"));
  BROADSIDE_TRY(binned_buckets_.reserve(n, "boxes"));
  BROADSIDE_TRY(chunk_count_.reserve(buckets / kBucketChunk, "boxes"));
  BROADSIDE_TRY(chunk_begin_.reserve(buckets / kBucketChunk + 1, "boxes"));
  if (bins.coarse_shift != 0) BROADSIDE_TRY(whole_buckets_.reserve(n, "boxes"));
  BROADSIDE_TRY(bins_.reserve(3 * std::size_t{bins.bins} + bins.coarse_bins() + blocks, "boxes"));
  return chunk_count_.fill_bytes(0);
}

core::Status BroadBuffers::load(Start start, const BoxFacts& facts, float hash_cell_m, core::Variant variant,
                                const BinsShape& bins, std::uint32_t blocks) {
  const std::size_t n = facts.count;
  view_ = {};
  bulk_ = {};
  view_.start = start;
  if (start == Start::kGrid) {
    const std::uint64_t buckets = grid_buckets(n);
    BROADSIDE_TRY(reserve_buckets(buckets, "grid"));
    BROADSIDE_TRY(rank_.reserve(n, "grid"));
    BROADSIDE_TRY(entries_.reserve(n, "grid"));
    BROADSIDE_TRY(levels_.reserve(1, "grid"));
    BROADSIDE_TRY(levels_.fill_bytes(0));
    view_.grid.bucket_mask = static_cast<std::uint32_t>(buckets - 1);
    view_.grid.axis_bits = axis_bits(buckets);
    refit(facts);
  } else if (start == Start::kBulk) {
    BROADSIDE_TRY(load_bulk(facts, bins, blocks));
    refit(facts);
  } else if (start == Start::kHash) {
    view_.hash.cells_per_m = 1.0F / hash_cell_m;
    Counters expected;
    expected.entries = std::max<std::uint64_t>(facts.hash_entries, kLeastBuckets);
    BROADSIDE_TRY(oversized_.reserve(n, "spatial hash"));
    BROADSIDE_TRY(grow(expected));
  } else if (start == Start::kOctree) {
    OctreeView& octree = view_.octree;
    octree.grid = core::make_scene_grid(facts.domain, variant == core::Variant::kE7 ? 1 : core::kSceneOctreeDepth);
    octree.same_node_only = variant == core::Variant::kE2;
    const std::uint32_t nodes = core::complete_octree_nodes(octree.grid.depth);
    BROADSIDE_TRY(node_count_.reserve(nodes, "scene octree"));
    BROADSIDE_TRY(node_begin_.reserve(nodes + 1, "scene octree"));
    BROADSIDE_TRY(rank_.reserve(n, "scene octree"));
    BROADSIDE_TRY(entries_.reserve(n, "scene octree"));
    BROADSIDE_TRY(range_end_.reserve(n, "scene octree"));
    BROADSIDE_TRY(node_count_.fill_bytes(0));
  }
  return core::Done{};
}

void BroadBuffers::refit(const BoxFacts& facts) {
  GridView& grid = view_.grid;
  grid.cell_m = largest_cell_m(view_.start, facts);
  grid.cells_per_m = 1.0F / grid.cell_m;
  // One cell of room below, so that what lies a little outside is still near in the table.
  for (int axis = 0; axis < 3; ++axis)
    grid.first_cell[axis] = static_cast<std::int32_t>(
        std::clamp(std::floor(facts.low_corner[axis] / grid.cell_m) - 1.0F, -1048576.0F, 1048576.0F));
  bulk_.cell_m = grid.cell_m;
  bulk_.cells_per_m = grid.cells_per_m;
  bulk_.levels_apart = facts.fit.levels_apart;
  bulk_.x_halvings = facts.fit.x_halvings;
  std::copy(std::begin(grid.first_cell), std::end(grid.first_cell), std::begin(bulk_.first_cell));
}

core::Status BroadBuffers::grow(const Counters& demanded) {
  if (view_.start != Start::kHash || demanded.entries <= hash_entries_.capacity()) return core::Done{};
  if (demanded.entries > kMostBuckets)
    return core::Error{"the spatial hash needs " + std::to_string(demanded.entries) + " entries of bodies in cells",
                       "hash-gpu", "use larger cells", core::Exit::kMissing};
  const std::uint64_t buckets = std::bit_ceil(demanded.entries);
  BROADSIDE_TRY(hash_entries_.reserve(demanded.entries, "spatial hash"));
  BROADSIDE_TRY(reserve_buckets(buckets, "spatial hash"));
  BROADSIDE_TRY(bucket_cursor_.reserve(buckets, "spatial hash"));
  BROADSIDE_TRY(bucket_cursor_.fill_bytes(0));
  view_.hash.bucket_mask = static_cast<std::uint32_t>(buckets - 1);
  return wait_for_device("clearing the spatial hash");
}

void BroadBuffers::fill(BroadView& view) const {
  view = view_;
  GridView& grid = view.grid;
  grid.count = bucket_count_.data();
  grid.begin = bucket_begin_.data();
  grid.rank = rank_.data();
  grid.entries = entries_.data();
  grid.levels = levels_.data();
  HashView& hash = view.hash;
  hash.count = bucket_count_.data();
  hash.begin = bucket_begin_.data();
  hash.cursor = bucket_cursor_.data();
  hash.entries = {hash_entries_.data(), hash_entries_.capacity()};
  hash.oversized = oversized_.data();
  OctreeView& octree = view.octree;
  octree.node_count = node_count_.data();
  octree.node_begin = node_begin_.data();
  octree.rank = rank_.data();
  octree.sorted = entries_.data();
  octree.range_end = range_end_.data();
}

void BroadBuffers::fill(BulkView& bulk) const {
  bulk = bulk_;
  bulk.count = bucket_count_.data();
  bulk.begin = bucket_begin_.data();
  bulk.rank = rank_.data();
  bulk.entries = bulk_entries_.data();
  bulk.levels = levels_.data();
  bulk.turns = bulk.levels + 2;
  bulk.bins.chunk_count = chunk_count_.data();
  bulk.bins.chunk_begin = chunk_begin_.data();
  bulk.bins.first_chunk = bins_.data();
  bulk.bins.last_chunk = bulk.bins.first_chunk + bulk.bins.shape.bins;
  bulk.bins.cursor = bulk.bins.last_chunk + bulk.bins.shape.bins;
  bulk.bins.coarse_cursor = bulk.bins.cursor + bulk.bins.shape.bins;
  bulk.bins.block_sum = bulk.bins.coarse_cursor + bulk.bins.shape.coarse_bins();
  bulk.bins.whole_bucket = whole_buckets_.data();
  bulk.bins.entries = binned_entries_.data();
  bulk.bins.bucket = binned_buckets_.data();
}

std::uint64_t BroadBuffers::bytes() const {
  return bucket_count_.bytes() + bucket_begin_.bytes() + bucket_cursor_.bytes() + rank_.bytes() + levels_.bytes() +
         entries_.bytes() + bulk_entries_.bytes() + binned_entries_.bytes() + binned_buckets_.bytes() +
         chunk_count_.bytes() + chunk_begin_.bytes() + whole_buckets_.bytes() + bins_.bytes() + hash_entries_.bytes() +
         oversized_.bytes() + node_count_.bytes() + node_begin_.bytes() + range_end_.bytes();
}

}  // namespace broadside::gpu
