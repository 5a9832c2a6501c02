// Looks for the partners that moving boxes have among standing ones, in the table of these. A lane takes a box, and
// looks at every level that has standing boxes: at coarser levels as bulk_search.cuh does; at finer ones, where it is
// longer than a cell, it goes through all cells that it covers, and compares boxes as they are.
//
// A standing box of a level is no longer than its cells. So it overlaps only where its lower corner lies between a cell
// before the moving box and the moving box's end: the bound of BulkSearch::lowest_cell holds whatever the other's size.
#pragma once

#include "gpu/broad/cross_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"
#include "gpu/stages/pairs_only/standing_cells.cuh"

namespace broadside::gpu {

// As BulkSearch::lowest_cell, on the level itself.
__device__ inline int lowest_partner_cell(int fine_min) {
  return ((fine_min - 1 - (abs(fine_min) >> 20)) >> kFineBits) - 1;
}

class CrossSearch {
 public:
  __device__ CrossSearch(const CrossView& view, PairQueue& room)
      : view_(view), queue_(room, view.pairs, &view.counters->pairs) {}

  // By the whole warp.
  __device__ void find_partners(const PackedBox& box, bool has_box) {
    has_box = has_box && may_have_standing(view_.cells, box);
    if (!__any_sync(kFullWarp, has_box)) return;
    const volatile std::uint32_t* known = view_.standing.levels;
    for (std::uint32_t left = known[0]; left != 0; left &= left - 1U)
      look_at_level(box, has_box, __ffs(static_cast<int>(left)) - 1);
  }
  __device__ void flush() { queue_.flush(); }

 private:
  __device__ void look_at_level(const PackedBox& box, bool looks, int level) {
    const BulkView& g = view_.standing;
    const float cells_per_m = scaled(g.cells_per_m, level);
    const CellCorner fine_min = fine_corner(box.min, cells_per_m);
    const CellCorner fine_max = fine_corner(box.max, cells_per_m);
    const TableCell low = table_cell(
        g, {lowest_partner_cell(fine_min.x), lowest_partner_cell(fine_min.y), lowest_partner_cell(fine_min.z)}, level);
    const TableCell high = table_cell(g, cell_above(fine_max, 0), level);
    const std::uint32_t rows_y = high.y - low.y + 1;
    const std::uint32_t rows_z = high.z - low.z + 1;
    // A standing box begins in these cells and ends at most one cell further: of three cells, all differences of
    // corners are less than the four cells that rounded boxes can tell.
    const bool is_short = high.x - low.x < 3 && rows_y < 4 && rows_z < 4;
    const CoarseBox coarse = coarse_box(fine_min, fine_max, 0);
    for (std::uint32_t z = 0; __any_sync(kFullWarp, looks && z < rows_z); ++z) {
      for (std::uint32_t y = 0; __any_sync(kFullWarp, looks && z < rows_z && y < rows_y); ++y) {
        TableCell cell{low.x, low.y + y, low.z + z};
        for (bool is_in_row = looks && z < rows_z && y < rows_y; __any_sync(kFullWarp, is_in_row);) {
          const std::uint32_t more = min(high.x - cell.x, row_mask(g) - (cell.x & row_mask(g)));
          std::uint32_t k = 0;
          std::uint32_t end = 0;
          if (is_in_row) {
            const std::uint32_t* at = g.begin + bucket_place(bucket_of(g, cell, level));
            k = at[0];
            end = at[more + 1];
          }
          walk(box, k, end, block_tag(g, cell, level), is_short, coarse);
          is_in_row = is_in_row && high.x - cell.x != more;
          cell.x += more + 1;
        }
      }
    }
  }

  __device__ void walk(const PackedBox& box, std::uint32_t k, std::uint32_t end, std::uint32_t row_tag, bool is_short,
                       CoarseBox coarse) {
    for (; __any_sync(kFullWarp, k < end); ++k) {
      bool is_pair = false;
      core::Pair pair{};
      if (k < end) {
        const BulkEntry other = view_.standing.entries[k];
        // Buckets are shared: an entry of another row that happens to be here is found from its own.
        if (((other.tag ^ row_tag) & kRowTag) == 0 && (!is_short || may_overlap(coarse, other.box))) {
          const PackedBox standing = view_.standing_boxes[other.body];
          is_pair = core::overlaps(unpack(box), unpack(standing));
          pair = core::make_pair_of(box.low_tag, standing.low_tag);
        }
      }
      queue_.push(is_pair, pair);
    }
  }

  const CrossView& view_;
  WarpQueue queue_;
};

// `shared`: a PairQueue a warp.
__device__ inline void run_cross(const CrossView& view, unsigned char* shared) {
  const GridTeam grid(view.barrier);
  CrossSearch search(view, reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32]);
  for (std::uint64_t first = warp_rank(grid) * 32; first < view.count; first += warp_count(grid) * 32) {
    const std::uint64_t place = first + lane();
    PackedBox box;
    if (place < view.count) box = view.moving_boxes[view.order[place].body];
    search.find_partners(box, place < view.count);
  }
  search.flush();
  grid.sync();
  if (grid.rank() != 0) return;
  mark_end(grid, view.outcome, FindStep::kSearch);
  if (view.counters->pairs > view.pairs.capacity) view.counters->is_aborted = 1;
  view.outcome->counters = *view.counters;
}

}  // namespace broadside::gpu
