// Looks for the partners that moving boxes have among standing ones, in the table of the standing ones. Most moving
// boxes have none, and the others often lie side by side, so a warp that took neighbors would have all the work or
// none. So first each lane takes a box, and the boxes that may have partners are listed. Then a warp takes one listed
// box after another, and looks at every level that has standing boxes. On coarser levels these are the rows of cells
// that bulk_search.cuh looks at; on finer ones, where the box is longer than a cell, they are all cells that it covers.
// Each lane looks up a row, several lanes share the row's entries, and exact boxes are compared.
//
// A standing box is no longer than the cells of its level. So it overlaps a moving box only if its lower corner lies
// between a cell's length before the moving box and the end of the moving box. The bound of lowest_cell therefore holds
// for moving boxes of any size.
#pragma once

#include "gpu/broad/cross_view.hpp"
#include "gpu/stages/broad/pair_queue.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"
#include "gpu/stages/pairs_only/standing_cells.cuh"

namespace broadside::gpu {

class CrossSearch {
 public:
  __device__ CrossSearch(const CrossView& view, PairQueue& room)
      : view_(view), queue_(room, view.pairs, &view.counters->pairs) {}

  // Called by the whole warp for one box.
  __device__ void find_partners(const PackedBox& box) {
    const volatile std::uint32_t* known = view_.standing.levels;
    for (std::uint32_t left = known[0]; left != 0; left &= left - 1U)
      look_at_level(box, __ffs(static_cast<int>(left)) - 1);
  }
  __device__ void flush() { queue_.flush(); }

 private:
  // How many lanes share a row: in meshes of triangles, rows have some ten entries.
  static constexpr std::uint32_t kLanesOfRow = 8;
  static constexpr std::uint32_t kRowsAtOnce = 32 / kLanesOfRow;

  struct Run {
    std::uint32_t k = 0;
    std::uint32_t end = 0;
    std::uint32_t row_tag = 0;
  };

  __device__ void look_at_level(const PackedBox& box, int level) {
    const BulkView& g = view_.standing;
    const float cells_per_m = scaled(g.cells_per_m, level);
    const CellCorner fine_min = fine_corner(box.min, cells_per_m);
    const CellCorner fine_max = fine_corner(box.max, cells_per_m);
    const TableCell low = table_cell(g, lowest_cell(g, fine_min, 0), level);
    const TableCell high = table_cell(g, cell_above(g, fine_max, 0), level);
    const std::uint32_t rows_y = high.y - low.y + 1;
    const std::uint32_t rows_z = high.z - low.z + 1;
    // A standing box begins in these cells and ends at most one cell farther. If these are at most three cells, all
    // differences of corners are less than the four cells that rounded boxes can tell apart.
    const bool is_short = (high.x - low.x) >> g.x_halvings < 3 && rows_y < 4 && rows_z < 4;
    const CoarseBox coarse = coarse_box(fine_min, fine_max, 0);
    // Each lane looks up where a row's run of entries is; few rows have entries.
    for (std::uint32_t first = 0; first < rows_y * rows_z; first += 32) {
      const std::uint32_t row = first + lane();
      TableCell cell{low.x, low.y + row % rows_y, low.z + row / rows_y};
      for (bool is_in_row = row < rows_y * rows_z; __any_sync(kFullWarp, is_in_row);) {
        const std::uint32_t more = min(high.x - cell.x, row_mask(g) - (cell.x & row_mask(g)));
        Run run;
        if (is_in_row) {
          const std::uint32_t* at = g.begin + bucket_place(bucket_of(g, cell, level));
          run = {at[0], at[more + 1], block_tag(g, cell, level)};
        }
        walk_runs(box, run, is_short, coarse);
        is_in_row = is_in_row && high.x - cell.x != more;
        cell.x += more + 1;
      }
    }
  }

  // Goes through the runs that the lanes hold, several at a time, each by kLanesOfRow lanes.
  __device__ void walk_runs(const PackedBox& box, const Run& own, bool is_short, CoarseBox coarse) {
    for (unsigned left = __ballot_sync(kFullWarp, own.k < own.end); left != 0;) {
      unsigned rest = left;
      for (std::uint32_t before = lane() / kLanesOfRow; before > 0; --before) rest &= rest - 1U;
      const std::uint32_t from = rest != 0 ? static_cast<std::uint32_t>(__ffs(static_cast<int>(rest))) - 1U : 0U;
      const std::uint32_t k = __shfl_sync(kFullWarp, own.k, from) + lane() % kLanesOfRow;
      const std::uint32_t end = __shfl_sync(kFullWarp, own.end, from);
      const std::uint32_t row_tag = __shfl_sync(kFullWarp, own.row_tag, from);
      walk(box, k, rest != 0 ? end : k, row_tag, is_short, coarse);
      for (std::uint32_t done = 0; done < kRowsAtOnce; ++done) left &= left - 1U;
    }
  }

  __device__ void walk(const PackedBox& box, std::uint32_t k, std::uint32_t end, std::uint32_t row_tag, bool is_short,
                       CoarseBox coarse) {
    for (; __any_sync(kFullWarp, k < end); k += kLanesOfRow) {
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

// Lists the moving boxes that may have partners, in any order. Called by whole warps.
__device__ inline void note_near_boxes(const GridTeam& grid, const CrossView& view) {
  for (std::uint64_t first = warp_rank(grid) * 32; first < view.count; first += warp_count(grid) * 32) {
    const std::uint64_t place = first + lane();
    const bool is_near = place < view.count && may_have_standing(view.cells, view.moving_boxes[place]);
    const unsigned all = __ballot_sync(kFullWarp, is_near);
    if (all == 0) continue;
    std::uint32_t to = 0;
    if (lane() == 0) to = atomicAdd(view.near_count, static_cast<std::uint32_t>(__popc(all)));
    to = __shfl_sync(kFullWarp, to, 0) + static_cast<std::uint32_t>(__popc(all & ((1U << lane()) - 1U)));
    if (is_near) view.near[to] = static_cast<std::uint32_t>(place);
  }
}

// `shared`: a PairQueue for each warp.
__device__ inline void run_cross(const CrossView& view, unsigned char* shared) {
  const GridTeam grid(view.barrier);
  note_near_boxes(grid, view);
  grid.sync();
  CrossSearch search(view, reinterpret_cast<PairQueue*>(shared)[threadIdx.x / 32]);
  const std::uint32_t near_count = *static_cast<const volatile std::uint32_t*>(view.near_count);
  for (std::uint64_t k = warp_rank(grid); k < near_count; k += warp_count(grid))
    search.find_partners(view.moving_boxes[view.near[k]]);
  search.flush();
  grid.sync();
  if (grid.rank() != 0) return;
  *view.near_count = 0;
  mark_end(grid, view.outcome, FindStep::kSearch);
  if (view.counters->pairs > view.pairs.capacity) view.counters->is_aborted = 1;
  view.outcome->counters = *view.counters;
}

}  // namespace broadside::gpu
