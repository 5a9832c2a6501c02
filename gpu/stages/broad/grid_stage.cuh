// The fast exact broad phase: a loose octree of unbounded depth, kept as a hash of its occupied cells. A body is in the
// cell that has its box's lower corner, on the finest level whose cells are at least as large as the box. So boxes of a
// cell of size c reach at most c past it. Cells of each level are half as large as those of the level before. Cells
// that follow each other in x are neighboring buckets, so that a row of cells is one run of entries.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/broad/bucket_stage.cuh"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/work_count.cuh"

namespace broadside::gpu {

// Cells of level 20 are a millionth of the largest box; smaller boxes are on that level too.
constexpr int kGridLevels = 21;
// Aligned runs of 32 cells of a row are sure to be neighboring buckets.
constexpr std::uint32_t kRowBits = 5;
static_assert((1U << kRowBits) <= kBucketChunk, "a row's buckets lie in one chunk");

struct CellCorner {
  int x = 0;
  int y = 0;
  int z = 0;

  __device__ bool operator==(const CellCorner& o) const { return x == o.x && y == o.y && z == o.z; }
};

// Monotone, also where it saturates: the last cell holds everything that lies beyond it.
__device__ inline int cell_index(float v, float cells_per_m) {
  return floor_to_int(v * cells_per_m);
}

// All cells of the grid beyond this are one cell, so that a row of cells is never longer than what rounding adds. A box
// is in a cell of at least 2^-18 of its coordinates, so only boxes that have left the world come here.
constexpr float kFarthestCell = 0x1p20F;
__device__ inline int near_cell_index(float v, float cells_per_m) {
  return floor_to_int(fminf(fmaxf(v * cells_per_m, -kFarthestCell), kFarthestCell));
}

__device__ inline CellCorner cell_of(core::Vec3 v, float cells_per_m) {
  return {cell_index(v.x, cells_per_m), cell_index(v.y, cells_per_m), cell_index(v.z, cells_per_m)};
}

// v times 2^exponent; v and the result must be normal numbers.
__device__ inline float scaled(float v, int exponent) {
  return __uint_as_float(__float_as_uint(v) + (static_cast<std::uint32_t>(exponent) << 23));
}

__device__ inline float cell_size(const GridView& g, int level) {
  return scaled(g.cell_m, -level);
}

__device__ inline CellCorner grid_cell(const GridView& g, core::Vec3 v, int level) {
  const float cells_per_m = scaled(g.cells_per_m, level);
  return {near_cell_index(v.x, cells_per_m), near_cell_index(v.y, cells_per_m), near_cell_index(v.z, cells_per_m)};
}

__device__ inline float largest_magnitude(core::Vec3 v) {
  return fmaxf(fabsf(v.x), fmaxf(fabsf(v.y), fabsf(v.z)));
}

// The finest level whose cells are at least as large as the box, and so large that rounding of the coordinates does not
// matter: at least 2^-18 of them, which is 32 units in the last place.
__device__ inline int grid_level(const GridView& g, const core::Box& box) {
  const core::Vec3 side = box.max - box.min;
  const float far = fmaxf(largest_magnitude(box.min), largest_magnitude(box.max)) * 0x1p-18F;
  const float needed = fmaxf(fmaxf(side.x, side.y), fmaxf(side.z, far));
  int level = 0;
  for (float next = 0.5F * g.cell_m; level + 1 < kGridLevels && next >= needed; next *= 0.5F) ++level;
  return level;
}

// Spreads the bits of a 16-bit number: bit k goes to bit 2 k.
__device__ inline std::uint32_t every_second_bit(std::uint32_t v) {
  v = (v | v << 8) & 0x00FF00FFU;
  v = (v | v << 4) & 0x0F0F0F0FU;
  v = (v | v << 2) & 0x33333333U;
  return (v | v << 1) & 0x55555555U;
}

// The lowest bits are a row of 32 cells, then rows that are neighbors in y and z, then slabs in x. If the table has a
// bucket for every cell of the world, that is all. The higher bits of the cell's numbers, and the level, are hashed,
// and scatter whole blocks over the table.
__device__ inline std::uint32_t bucket_of(const GridView& g, CellCorner c, int level) {
  const auto offset = [level](int first) { return static_cast<std::uint32_t>(first) << level; };
  const std::uint32_t x = static_cast<std::uint32_t>(c.x) - offset(g.first_cell[0]);
  const std::uint32_t y = static_cast<std::uint32_t>(c.y) - offset(g.first_cell[1]);
  const std::uint32_t z = static_cast<std::uint32_t>(c.z) - offset(g.first_cell[2]);
  const std::uint32_t low = (1U << g.axis_bits) - 1U;
  const std::uint32_t x_bits = max(g.axis_bits, kRowBits);
  const std::uint32_t near = (x & ((1U << kRowBits) - 1U)) |
                             (every_second_bit(y & low) | every_second_bit(z & low) << 1) << kRowBits |
                             ((x & ((1U << x_bits) - 1U)) >> kRowBits) << (kRowBits + 2 * g.axis_bits);
  std::uint32_t far = (x >> x_bits) * 0x9E3779B1U ^ (y >> g.axis_bits) * 0x85EBCA6BU ^
                      (z >> g.axis_bits) * 0xC2B2AE35U ^ static_cast<std::uint32_t>(level) * 0x27D4EB2FU;
  far = (far ^ far >> 15) * 0x2C1B3C6DU;
  return (near ^ (far ^ far >> 16) << kRowBits) & g.bucket_mask;
}

// Counts this box into its bucket. The place within the bucket depends on the order of the threads, but no result
// depends on it.
__device__ inline void grid_count(const GridView& g, std::uint64_t body, const core::Box& box) {
  const int level = grid_level(g, box);
  const std::uint32_t bucket = bucket_of(g, grid_cell(g, box.min, level), level);
  g.rank[body] = atomicAdd(&g.count[bucket], 1U);
  if ((*static_cast<volatile std::uint32_t*>(g.levels) >> level & 1U) == 0) atomicOr(g.levels, 1U << level);
}

// The tag of an entry: 7 bits of each coordinate of its cell, its level, and the static mark. Boxes that overlap are in
// cells of a level that are at most three apart on every axis, so that 7 bits tell which cell it is.
constexpr std::uint32_t kStaticTag = 1U << 31;
constexpr std::uint32_t kCellTag = (1U << 7) - 1U;
constexpr std::uint32_t kRunTag = ((1U << 26) - 1U) & ~((1U << kRowBits) - 1U);  // all but the place in a run

// x is counted from the first cell of the table, where its runs of cells begin.
__device__ inline std::uint32_t cell_tag(const GridView& g, CellCorner c, int level) {
  return ((static_cast<std::uint32_t>(c.x) - (static_cast<std::uint32_t>(g.first_cell[0]) << level)) & kCellTag) |
         (static_cast<std::uint32_t>(c.y) & kCellTag) << 7 | (static_cast<std::uint32_t>(c.z) & kCellTag) << 14 |
         static_cast<std::uint32_t>(level) << 21;
}
__device__ inline int level_of_tag(std::uint32_t tag) {
  return static_cast<int>(tag >> 21 & 31U);
}

template <typename Team>
__device__ void grid_scatter(const Team& team, const GridView& g, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t i = team.rank(); i < count; i += team.size()) {
    PackedBox box = boxes[i];
    const int level = grid_level(g, unpack(box));
    const CellCorner cell = grid_cell(g, box.min, level);
    box.high_tag = cell_tag(g, cell, level) | (box.high_tag != 0 ? kStaticTag : 0U);
    box.low_tag = static_cast<std::uint32_t>(i);
    g.entries[g.begin[bucket_place(bucket_of(g, cell, level))] + g.rank[i]] = box;
  }
}

// Cells of one level in which the partners of a box may be. A box b of that level overlaps q only if its lower corner
// is between q.min - c and q.max; a thousandth of a cell and 2^-20 of the coordinate cover all rounding in between (at
// most a few units in the last place, 2^-23 of a coordinate that is at most 2^18 cells).
struct CellRange {
  CellCorner low;
  CellCorner high;
};
__device__ inline CellRange partner_cells(const GridView& g, const PackedBox& q, int level) {
  const float c = cell_size(g, level);
  const auto reach = [c](float v) { return v - c - (c * 0x1p-10F + fabsf(v) * 0x1p-20F); };
  return {grid_cell(g, {reach(q.min.x), reach(q.min.y), reach(q.min.z)}, level), grid_cell(g, q.max, level)};
}

// A run of entries that one box is to be tested against.
struct EntryRun {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t tag = 0;  // what its entries' tags must be under kRunTag
};

// The rows of cells in which a box looks for partners on one level. Two boxes of one level would find each other twice,
// so only one of them looks: the one in the lexicographically lower cell (z, y, x) or, in one cell, the one with the
// lower id.
class RowSearch {
 public:
  __device__ RowSearch(const GridView& g, const PackedBox& q, int own_level, int level)
      : level_(level), is_own_level_(level == own_level), range_(partner_cells(g, q, level)) {
    rows_in_y_ = static_cast<std::uint32_t>(range_.high.y - range_.low.y) + 1;
    rows_ = rows_in_y_ * (static_cast<std::uint32_t>(range_.high.z - range_.low.z) + 1);
    if (is_own_level_) {
      own_ = grid_cell(g, q.min, level);
      // Boxes of the rows before the own row find this box.
      first_ = static_cast<std::uint32_t>(own_.z - range_.low.z) * rows_in_y_ +
               static_cast<std::uint32_t>(own_.y - range_.low.y);
      rows_ -= first_;
    }
  }

  __device__ std::uint32_t rows() const { return rows_; }

  // Gives the run of the k-th row that starts at its x-th cell, and moves x past the run, which ends where buckets no
  // longer follow each other. Returns whether the row has more.
  __device__ bool next_run(const GridView& g, std::uint32_t k, std::uint32_t& x, EntryRun& run) const {
    CellCorner c{(is_own_level_ && k == 0 ? own_.x : range_.low.x) + static_cast<int>(x), range_.low.y, range_.low.z};
    std::uint32_t row = first_ + k;
    for (; row >= rows_in_y_; row -= rows_in_y_) ++c.z;  // a few steps: cheaper than a division
    c.y += static_cast<int>(row);
    const std::uint32_t bucket = bucket_of(g, c, level_);
    const std::uint32_t room = (1U << kRowBits) - 1U - (bucket & ((1U << kRowBits) - 1U));
    const std::uint32_t more = min(static_cast<std::uint32_t>(range_.high.x - c.x), room);
    run.begin = g.begin[bucket_place(bucket)];
    run.end = g.begin[bucket_place(bucket + more) + 1];
    run.tag = cell_tag(g, c, level_) & kRunTag;
    x += more + 1;
    return c.x + static_cast<int>(more) < range_.high.x;
  }

 private:
  int level_;
  bool is_own_level_;
  CellRange range_;
  CellCorner own_;
  std::uint32_t rows_in_y_ = 1;
  std::uint32_t rows_ = 0;
  std::uint32_t first_ = 0;
};

// The runs that the lanes of a group hold, joined in the order of the lanes: locate() finds entry t of all of them.
template <std::uint32_t kGroup>
class RunsOfGroup {
 public:
  __device__ explicit RunsOfGroup(const EntryRun& run) {
    const std::uint32_t first_lane = lane() / kGroup * kGroup;
    const std::uint32_t length = run.end - run.begin;
#pragma unroll
    for (std::uint32_t k = 0; k < kGroup; ++k) {
      start_[k] = __shfl_sync(kFullWarp, run.begin, first_lane + k) - total_;
      tag_[k] = __shfl_sync(kFullWarp, run.tag, first_lane + k);
      total_ += __shfl_sync(kFullWarp, length, first_lane + k);
      end_[k] = total_;
    }
  }

  __device__ std::uint32_t total() const {
    return total_;
  }
  __device__ void locate(std::uint32_t t, std::uint32_t& entry, std::uint32_t& tag) const {
    std::uint32_t start = start_[0];
    tag = tag_[0];
#pragma unroll
    for (std::uint32_t k = 1; k < kGroup; ++k) {
      const bool is_past = t >= end_[k - 1];
      start = is_past ? start_[k] : start;
      tag = is_past ? tag_[k] : tag;
    }
    entry = start + t;
  }

 private:
  std::uint32_t start_[kGroup];
  std::uint32_t end_[kGroup];
  std::uint32_t tag_[kGroup];
  std::uint32_t total_ = 0;
};

// Tests one box of each group against the runs that its lanes hold; each lane takes one entry at a time.
template <std::uint32_t kGroup, typename Work>
__device__ void test_runs(const GridView& g, const PackedBox& q, const EntryRun& run, WarpQueue& queue, Work& work) {
  if (!__any_sync(kFullWarp, run.end > run.begin)) return;
  const RunsOfGroup<kGroup> runs(run);
  for (std::uint32_t t = lane() % kGroup; __any_sync(kFullWarp, t < runs.total()); t += kGroup) {
    bool hit = false;
    std::uint32_t other_id = 0;
    if (t < runs.total()) {
      std::uint32_t k = 0;
      std::uint32_t tag = 0;
      runs.locate(t, k, tag);
      const PackedBox other = g.entries[k];
      work.tests(1);
      other_id = other.low_tag;
      // Cells may share a bucket: entries of other cells than the run's are skipped here, since their own run finds
      // them. In one cell the box with the lower id finds the other.
      hit = core::overlaps(unpack(q), unpack(other)) && ((other.high_tag ^ tag) & kRunTag) == 0 &&
            ((other.high_tag ^ q.high_tag) << 6 != 0 || other_id > q.low_tag) &&
            (q.high_tag & other.high_tag & kStaticTag) == 0;
    }
    queue.push(hit, core::make_pair_of(q.low_tag, other_id));
  }
}

// Every pair is found from its smaller box: a box looks at its own level and at those of larger cells, so that the many
// overlaps of a very large box are found by its many partners. A group of lanes takes a box. Each lane looks up a row
// of cells, so that the loads of all rows wait together; then all lanes test the entries of the rows.
template <std::uint32_t kGroup, typename Team, typename Work>
__device__ void grid_find_by(const Team& team, const GridView& g, std::uint32_t count, WarpQueue& queue, Work& work) {
  const std::uint32_t occupied = *static_cast<volatile std::uint32_t*>(g.levels);
  const std::uint64_t groups = team.size() / kGroup;
  const std::uint64_t rounds = (count + groups - 1) / groups;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t place = round * groups + team.rank() / kGroup;
    const bool has_box = place < count;
    if (!__any_sync(kFullWarp, has_box)) break;
    PackedBox q;
    if (has_box) q = g.entries[place];
    const int own_level = has_box ? level_of_tag(q.high_tag) : -1;
    std::uint32_t left = has_box ? occupied & ((2U << own_level) - 1U) : 0U;
    while (__any_sync(kFullWarp, left != 0)) {
      const int level = left != 0 ? 31 - __clz(left) : 0;
      const RowSearch search(g, q, own_level, level);
      const std::uint32_t rows = left != 0 ? search.rows() : 0U;
      left &= (1U << level) - 1U;
      for (std::uint32_t first = 0; __any_sync(kFullWarp, first < rows); first += kGroup) {
        const std::uint32_t row = first + lane() % kGroup;
        std::uint32_t x = 0;
        bool has_run = row < rows;
        do {
          EntryRun run;
          if (has_run) {
            has_run = search.next_run(g, row, x, run);
            work.node();
          }
          test_runs<kGroup>(g, q, run, queue, work);
        } while (__any_sync(kFullWarp, has_run));
      }
    }
  }
}

// If boxes are few, more lanes for each hide more waiting; if they are many, fewer lanes for each means fewer idle
// lanes at short runs.
template <typename Team, typename Work>
__device__ void grid_find(const Team& team, const GridView& g, std::uint32_t count, WarpQueue& queue, Work& work) {
  if (std::uint64_t{count} * 8 <= team.size())
    grid_find_by<8>(team, g, count, queue, work);
  else
    grid_find_by<4>(team, g, count, queue, work);
}

}  // namespace broadside::gpu
