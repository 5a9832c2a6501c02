// The launch before the search of bulk pairs from a million boxes on: it puts entries in order by bins. Only the two
// files of kernels include this file, and only this file includes bulk_bins.cuh and bulk_chunks.cuh. Without it
// bulk_sort.cuh would sort bulk pairs, which takes 7 % longer at a million boxes and 16 % at ten million.
#pragma once

#include "gpu/stages/pairs_only/bulk_bins.cuh"
#include "gpu/stages/pairs_only/bulk_chunks.cuh"
#include "gpu/stages/pairs_only/pairs.cuh"

namespace broadside::gpu {

// `shared`: the block's shared memory, BinsShape::shared_bytes of it.
__device__ inline void run_sort(const PairsView& view, unsigned char* shared) {
  const GridTeam grid(view.barrier);
  const BulkView& bulk = view.bulk;
  mark_begin(grid, view.outcome);
  if (grid.rank() == 0) start_counts(view);
  count_chunks(grid, bulk, view.boxes, view.box_count);
  grid.sync();
  mark_end(grid, view.outcome, FindStep::kCount);
  place_chunks_in_order(grid, bulk, reinterpret_cast<std::uint32_t*>(shared));
  grid.sync();
  mark_end(grid, view.outcome, FindStep::kPlace);
  if (bulk.bins.shape.coarse_shift == 0) {
    fill_bins(bulk, BoxesToBins{bulk, view.boxes}, view.box_count, shared);
  } else {
    fill_bins(bulk, BoxesToCoarseBins{{bulk, view.boxes}}, view.box_count, shared);
    grid.sync();
    fill_bins(bulk, CoarseBinsToBins{{bulk, view.boxes}}, view.box_count, shared);
  }
  grid.sync();
  empty_bins(bulk, shared);
  end_entries(grid, bulk, view.box_count);
}

}  // namespace broadside::gpu
