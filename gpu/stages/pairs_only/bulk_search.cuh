// The search of bulk pairs, that is of boxes without a simulation. Every pair is found from its smaller box: a box
// looks at its own level and at those of larger cells, so that the many overlaps of a very large box are found by its
// many partners.
//
// A lane takes a box. If boxes are few and have many others in their cells, four lanes take one box, each a share of
// every run of entries. A lane goes through the rows of cells in which partners may be, and notes the entries whose
// rounded boxes overlap its own. For most of these the rounded boxes show that they are partners; for the others it
// tests the exact boxes. Lanes of a warp have boxes of neighboring cells, so they mostly read the same entries.
//
// Why there are two searches: this one does the least work for each box, but waits for the rows of a box one after
// another. With tens of thousands of boxes there are enough warps to hide that; with fewer the search of
// grid_stage.cuh, in which lanes share a box, is faster. Frames use that search too, since their kernel has no
// registers and no shared memory to spare: this search made a pile of 100 000 cubes 13 % slower.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"
#include "gpu/stages/work_count.cuh"

namespace broadside::gpu {

// One warp's notes, in shared memory.
struct BulkNotes {
  static constexpr std::uint32_t kHits = 24;
  static constexpr std::uint32_t kUnsure = 1U << 31;
  PairQueue queue;
  std::uint32_t hit[kHits][32];  // what each lane has found: first its entry, later its body; kUnsure: test exactly
};

// Names boxes in pairs by the search's own numbers; named_pairs.cuh has another way.
struct OwnNumbers {
  __device__ bool keeps(std::uint32_t /*a*/, std::uint32_t /*b*/) const { return true; }
  __device__ core::Pair pair_of(bool /*is_pair*/, std::uint32_t a, std::uint32_t b) const {
    return core::make_pair_of(a, b);
  }
};

// A lane searches for the partners of one box after another. Every call is by the whole warp. `kLanes` neighboring
// lanes, a power of two, have the same box.
template <typename Work, typename Names = OwnNumbers, std::uint32_t kLanes = 1>
class BulkSearch {
 public:
  __device__ BulkSearch(const BulkView& g, const PackedBox* boxes, BulkNotes& notes, AppendView<core::Pair> out,
                        unsigned long long* demanded, Names names = {})
      : g_(g), boxes_(boxes), notes_(notes), names_(names), queue_(notes.queue, out, demanded) {}

  // Searches for the partners of the box at this place among the entries.
  __device__ void find_partners(std::uint32_t place, bool has_box, LevelMarks marks) {
    place_ = place;
    BulkEntry entry;
    PackedBox box;
    if (has_box) {
      entry = g_.entries[place];
      box = boxes_[entry.body];
    }
    body_ = entry.body;
    own_level_ = bulk_level_of_tag(entry.tag);
    static_tag_ = entry.tag & kStaticTag;
    const float cells_per_m = scaled(g_.cells_per_m, own_level_);
    fine_min_ = fine_corner(box.min, cells_per_m);
    fine_max_ = fine_corner(box.max, cells_per_m);
    std::uint32_t left = has_box ? marks.occupied & ((2U << own_level_) - 1U) : 0U;
    while (__any_sync(kFullWarp, left != 0)) {
      const bool looks = left != 0;
      const int level = looks ? 31 - __clz(left) : 0;
      left &= (1U << level) - 1U;
      unsure_ = (marks.wide >> level | marks.wide >> own_level_) & 1U;
      look_at_level(level, looks);
      settle();
    }
    look_closely();
  }

  __device__ void flush() { queue_.flush(); }
  __device__ const Work& work() const { return work_; }

 private:
  // How many entries of a run each lane reads at once.
  static constexpr std::uint32_t kEntriesAtOnce = 4;
  static_assert((kEntriesAtOnce - 1) * kLanes <= kEntriesBehind);
  // Three rows are looked up at a time, so that their loads wait together; a box seldom has more in y.
  static constexpr std::uint32_t kRows = 3;

  struct Runs {
    std::uint32_t k[kRows];
    std::uint32_t end[kRows];
  };

  // Two boxes of one level would find each other twice, so only one of them looks: the one in the lexicographically
  // lower cell (z, y, x) or, in one cell, the one whose entry comes first.
  __device__ void look_at_level(int level, bool looks) {
    const int coarser = own_level_ - level;
    const bool is_own_level = coarser == 0;
    coarse_ = coarse_box(fine_min_, fine_max_, coarser);
    const TableCell own = table_cell(g_, cell_above(g_, fine_min_, coarser), level);
    const TableCell high = table_cell(g_, cell_above(g_, fine_max_, coarser), level);
    TableCell low = table_cell(g_, lowest_cell(g_, fine_min_, coarser), level);
    if (is_own_level) low.z = own.z;
    // The cells that a box looks at seldom belong to several blocks.
    const bool has_blocks =
        __any_sync(kFullWarp, looks && ((low.x ^ high.x) >> g_.x_bits | (low.y ^ high.y) >> g_.axis_bits |
                                        (low.z ^ high.z) >> g_.axis_bits) != 0);
    const std::uint32_t block = block_of(g_, low, level);
    const std::uint32_t rows_y = high.y - low.y + 1;
    const std::uint32_t rows_z = high.z - low.z + 1;
    for (std::uint32_t y = 0;; y += kRows) {
      const bool has_more_y = __any_sync(kFullWarp, looks && y + kRows < rows_y);
      for (std::uint32_t z = 0;; ++z) {
        const bool has_more_z = __any_sync(kFullWarp, looks && z + 1 < rows_z);
        // If a row of cells is cut into two runs, the loop takes both.
        TableCell cell{low.x, low.y + y, low.z + z};
        for (bool is_in_row = looks && z < rows_z;;) {
          const std::uint32_t more = min(high.x - cell.x, row_mask(g_) - (cell.x & row_mask(g_)));
          const bool goes_on = is_in_row && high.x - cell.x != more;
          const bool has_more_x = __any_sync(kFullWarp, goes_on);
          Runs runs;
#pragma unroll
          for (std::uint32_t j = 0; j < kRows; ++j) {
            runs.k[j] = runs.end[j] = 0;
            const TableCell first{cell.x, cell.y + j, cell.z};
            const auto rows_on = static_cast<int>(first.y - own.y);
            const bool is_own_layer = is_own_level && cell.z == own.z;
            const bool is_own_row = is_own_layer && rows_on == 0;
            const int on = is_own_row ? static_cast<int>(own.x - cell.x) : 0;
            if (!is_in_row || y + j >= rows_y || (is_own_layer && rows_on < 0) || on > static_cast<int>(more)) continue;
            const std::uint32_t bucket = bucket_in_block(g_, first) ^ (has_blocks ? block_of(g_, first, level) : block);
            const std::uint32_t* at = g_.begin + bucket_place(bucket);
            runs.k[j] = is_own_row && on >= 0 ? place_ + 1 : at[0];
            runs.end[j] = at[more + 1];
            if (lane() % kLanes == 0) work_.node();
            runs.k[j] += lane() % kLanes;
          }
          walk(runs, cell, level);
          if (!has_more_x) break;
          is_in_row = goes_on;
          cell.x += more + 1;
        }
        if (!has_more_z) break;
      }
      if (!has_more_y) break;
    }
  }

  // Notes possible partners in three rows, the first of which begins at `cell`. A lane whose notes are full waits.
  // Lanes of one box take neighboring entries, so that together they load from one line of memory.
  __device__ void walk(Runs& runs, TableCell cell, int level) {
    // Two static boxes are no pair.
    const std::uint32_t tag_mask = kRowTag | static_tag_;
    for (bool has_more = true; has_more;) {
      has_more = false;
#pragma unroll
      for (std::uint32_t j = 0; j < kRows; ++j) {
        // Cells may share a bucket: entries of other rows are skipped here, since their own row finds them.
        const std::uint32_t row_tag = block_tag(g_, {cell.x, cell.y + j, cell.z}, level);
        while (runs.k[j] < runs.end[j] && hits_ <= BulkNotes::kHits - kEntriesAtOnce) {
          work_.tests(min(kEntriesAtOnce, (runs.end[j] - runs.k[j] + kLanes - 1) / kLanes));
          BulkEntry other[kEntriesAtOnce];
#pragma unroll
          for (std::uint32_t k = 0; k < kEntriesAtOnce; ++k) other[k] = g_.entries[runs.k[j] + k * kLanes];
#pragma unroll
          for (std::uint32_t k = 0; k < kEntriesAtOnce; ++k) {
            const std::uint32_t at = runs.k[j] + k * kLanes;
            const bool is_noted =
                at < runs.end[j] && may_overlap(coarse_, other[k].box) && ((other[k].tag ^ row_tag) & tag_mask) == 0;
            if (is_noted) notes_.hit[hits_][lane()] = at;
            hits_ += is_noted ? 1U : 0U;
          }
          runs.k[j] += kEntriesAtOnce * kLanes;
        }
        has_more = has_more || __any_sync(kFullWarp, runs.k[j] < runs.end[j]);
      }
      if (has_more) settle(), look_closely();
    }
  }

  // For what was noted on this level: replaces the entry by its body, and marks it if the rounded boxes leave a doubt.
  __device__ void settle() {
#pragma unroll 2
    for (std::uint32_t k = settled_; k < hits_; ++k) {
      const BulkEntry other = g_.entries[notes_.hit[k][lane()]];
      const bool is_unsure = unsure_ != 0 || !surely_overlap(coarse_, other.box);
      notes_.hit[k][lane()] = is_unsure ? other.body | BulkNotes::kUnsure : other.body;
    }
    settled_ = hits_;
  }

  // Puts what each lane has noted into the queue, after it has tested the exact boxes of doubtful notes.
  __device__ void look_closely() {
    std::uint32_t unsure = 0;  // bit k: the k-th note
    for (std::uint32_t k = 0; k < hits_; ++k) unsure |= notes_.hit[k][lane()] >> 31 << k;
    // Two at a time, so that their loads wait together.
    std::uint32_t left = unsure;
    if (__any_sync(kFullWarp, left != 0)) {
      const PackedBox own = boxes_[body_];  // loaded again: keeping it would cost registers
      while (left != 0) {
        const std::uint32_t first = __ffs(static_cast<int>(left)) - 1;
        left &= left - 1U;
        const std::uint32_t second = left != 0 ? __ffs(static_cast<int>(left)) - 1 : first;
        left &= left - 1U;
        const std::uint32_t a = notes_.hit[first][lane()] & ~BulkNotes::kUnsure;
        const std::uint32_t b = notes_.hit[second][lane()] & ~BulkNotes::kUnsure;
        const PackedBox box_a = boxes_[a];
        const PackedBox box_b = boxes_[b];
        if (core::overlaps(unpack(own), unpack(box_a))) notes_.hit[first][lane()] = a;
        if (core::overlaps(unpack(own), unpack(box_b))) notes_.hit[second][lane()] = b;
      }
    }
    for (std::uint32_t k = 0; __any_sync(kFullWarp, k < hits_); ++k) {
      const std::uint32_t other = k < hits_ ? notes_.hit[k][lane()] : BulkNotes::kUnsure;
      const bool is_pair = (other & BulkNotes::kUnsure) == 0 && names_.keeps(body_, other);
      queue_.push(is_pair, names_.pair_of(is_pair, body_, other));
    }
    hits_ = settled_ = 0;
  }

  const BulkView& g_;
  const PackedBox* boxes_;
  BulkNotes& notes_;
  Names names_;
  WarpQueue queue_;
  Work work_;
  CellCorner fine_min_;
  CellCorner fine_max_;
  CoarseBox coarse_;  // in cells of the level that is searched
  std::uint32_t body_ = 0;
  std::uint32_t place_ = 0;
  int own_level_ = 0;
  std::uint32_t static_tag_ = 0;
  std::uint32_t unsure_ = 0;   // whether cells of this level may be confused with others
  std::uint32_t hits_ = 0;     // how many notes the lane has
  std::uint32_t settled_ = 0;  // how many of these settle() has seen
};

// A share of the boxes, by their places among the entries.
struct BulkSlice {
  std::uint64_t first = 0;
  std::uint64_t end = 0;
};

// A warp takes new boxes when it has finished its own, because boxes in a crowd have many partners and others few.
// `g.turns` must be zero before.
template <std::uint32_t kLanes = 1, typename Team, typename Names = OwnNumbers>
__device__ void bulk_find(const Team& team, const BulkView& g, const PackedBox* boxes, BulkSlice slice,
                          BulkNotes& notes, AppendView<core::Pair> out, unsigned long long* demanded,
                          Names names = {}) {
  const volatile std::uint32_t* known = g.levels;
  const LevelMarks marks{known[0], known[1]};
  BulkSearch<Uncounted, Names, kLanes> search(g, boxes, notes, out, demanded, names);
  const std::uint64_t count = slice.end - slice.first;
  // If boxes are few, a warp takes fewer than it has lanes, because it lasts as long as its slowest lane.
  const std::uint64_t warps = warp_count(team);
  std::uint32_t width = 32 / kLanes;
  while (width > 4 && count <= warps * (width / 2)) width /= 2;
  // If boxes are many, a warp takes several turns at once, as long as each warp still has some sixteen: all warps take
  // them from one word, which costs some 2 ns each time.
  const std::uint32_t turns = min(static_cast<std::uint32_t>(count / (team.size() * 16)), 3U) + 1;
  // Each warp's first turns are fixed, in an order that spreads few boxes over all multiprocessors.
  std::uint64_t first = team.spread_rank() / 32 * width * turns;
  while (first < count) {
    std::uint64_t next = 0;
    if (lane() == 0) next = (warps + atomicAdd(g.turns, 1U)) * width * turns;
    for (std::uint32_t k = 0; k < turns; ++k) {
      const std::uint32_t own = lane() / kLanes;
      const std::uint64_t place = first + k * width + own;
      search.find_partners(static_cast<std::uint32_t>(slice.first + place), own < width && place < count, marks);
    }
    first = __shfl_sync(kFullWarp, next, 0);
  }
  search.flush();
}

}  // namespace broadside::gpu
