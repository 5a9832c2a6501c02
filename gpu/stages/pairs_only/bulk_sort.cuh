// Sorts boxes of bulk pairs into their buckets in one step: atomics count them, buckets get ranges, boxes are written.
// Each box is written to another place in memory, which is what takes the time.
#pragma once

#include "gpu/stages/broad/bucket_stage.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/pairs_only/bulk_cells.cuh"

namespace broadside::gpu {

// A thread takes several boxes at once, so that it waits for all their loads together.
constexpr std::uint32_t kBoxesAtOnce = 4;

// The entries behind the last one, which reads past the end of a run may meet, get a tag that matches no cell.
template <typename Team>
__device__ void end_entries(const Team& team, const BulkView& g, std::uint32_t count) {
  if (team.rank() < kEntriesBehind) g.entries[count + team.rank()] = {{}, 0, kNoCellTag};
}

// Counts boxes into buckets. The place within a bucket depends on the order of the threads, but no result depends on
// it.
template <typename Team>
__device__ void bulk_count(const Team& team, const BulkView& g, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t first = team.rank(); first < count; first += team.size() * kBoxesAtOnce) {
    PackedBox box[kBoxesAtOnce];
    std::uint32_t rank[kBoxesAtOnce];
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
      rank[k] = atomicAdd(&g.count[bucket_of(g, cell, level)], 1U);
    }
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k)
      if (first + k * team.size() < count) g.rank[first + k * team.size()] = rank[k];
    marks.note(g);
  }
}

template <typename Team>
__device__ void bulk_scatter(const Team& team, const BulkView& g, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t first = team.rank(); first < count; first += team.size() * kBoxesAtOnce) {
    PackedBox box[kBoxesAtOnce];
    std::uint32_t place[kBoxesAtOnce];
    BulkEntry entry[kBoxesAtOnce];
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
      const std::uint64_t i = first + k * team.size();
      if (i >= count) break;
      box[k] = boxes[i];
      place[k] = g.rank[i];
    }
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k) {
      const std::uint64_t i = first + k * team.size();
      if (i >= count) break;
      const BulkPlace to = place_of(g, box[k], static_cast<std::uint32_t>(i));
      place[k] += g.begin[bucket_place(to.bucket)];
      entry[k] = to.entry;
    }
#pragma unroll
    for (std::uint32_t k = 0; k < kBoxesAtOnce; ++k)
      if (first + k * team.size() < count) g.entries[place[k]] = entry[k];
  }
  end_entries(team, g, count);
}

}  // namespace broadside::gpu
