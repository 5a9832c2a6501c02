// Finds the bulk pairs of a share of the boxes and names them by the caller's numbers: see broad/named_pairs_view.hpp.
#pragma once

#include "gpu/broad/named_pairs_view.hpp"
#include "gpu/stages/pairs_only/pairs.cuh"

namespace broadside::gpu {

struct CallersNumbers {
  const PackedBox* boxes = nullptr;
  PairNames names;

  __device__ bool keeps(std::uint32_t a, std::uint32_t b) const {
    return a < names.first_guest || b < names.first_guest;
  }
  __device__ std::uint32_t number(std::uint32_t box) const {
    return box < names.first_told ? names.base + box : boxes[box].low_tag;
  }
  // If it is not a pair, `b` may not be a box either, so its number must not be looked up.
  __device__ core::Pair pair_of(bool is_pair, std::uint32_t a, std::uint32_t b) const {
    return is_pair ? core::make_pair_of(number(a), number(b)) : core::Pair{};
  }
};

__device__ inline void run_named_pairs(const NamedPairsView& view, unsigned char* shared) {
  const PairsView& search = view.search;
  const BulkView& bulk = search.bulk;
  const GridTeam grid(search.barrier);
  BulkNotes& notes = reinterpret_cast<BulkNotes*>(shared)[threadIdx.x / 32];
  const bool is_sorted = bulk.bins.shape.bins != 0;
  if (view.is_in_order || !is_sorted) {
    mark_begin(grid, search.outcome);
    if (grid.rank() == 0) start_counts(search);
    if (!view.is_in_order) bulk_count(grid, bulk, search.boxes, search.box_count);
    grid.sync();
    mark_end(grid, search.outcome, FindStep::kCount);
  }
  if (!view.is_in_order && !is_sorted) {
    place_buckets(grid, bulk.bucket_mask, bulk.count, bulk.begin, &search.counters->entry_cursor);
    grid.sync();
    mark_end(grid, search.outcome, FindStep::kPlace);
    bulk_scatter(grid, bulk, search.boxes, search.box_count);
    grid.sync();
  }
  if (view.is_in_order) mark_end(grid, search.outcome, FindStep::kPlace);
  mark_end(grid, search.outcome, FindStep::kScatter);
  bulk_find(grid, bulk, search.boxes, {view.first_place, view.end_place}, notes, search.pairs, &search.counters->pairs,
            CallersNumbers{search.boxes, view.names});
  grid.sync();
  if (grid.rank() != 0) return;
  mark_end(grid, search.outcome, FindStep::kSearch);
  search.counters->is_aborted = search.counters->pairs > search.pairs.capacity ? 1 : 0;
  search.outcome->counters = *search.counters;
}

}  // namespace broadside::gpu
