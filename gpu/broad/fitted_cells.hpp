// Chooses how much larger than the largest box the largest cells of bulk pairs are, and how many lanes look for the
// partners of a box.
//
// A box lies in a cell of one to four times its own size, since bulk pairs use even levels only. Whether most boxes of
// a set are a little or much shorter than their cells depends on how their sizes compare with the largest one. Making
// the largest cells larger moves all levels together. The sizes alone do not tell how that changes the number of tests,
// so it is counted in a sample.
//
// A warp lasts as long as its slowest lane, and the launch as long as its slowest warp. Neighbors in the order are
// neighbors in space, so a warp in a crowd has all the work. Where boxes are so few that most warps take boxes only
// once, four lanes for each box spread that work over more warps. The lanes share a row of cells; if a row had few
// entries, most of them would wait. With four lanes, cells are also halved along x: a row of cells is one run of
// entries, which then ends nearer to the box.
//
// A box looks for partners on its own level and on all coarser ones that have boxes. Where sizes span many octaves and
// few boxes are on each level, most rows of cells that it looks at are empty: then levels are four octaves apart.
//
// Where a box has many tests in its cells, groups of neighboring boxes are searched instead of cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "gpu/broad/broad_buffers.hpp"

namespace broadside::gpu {

// Cells are scaled by 1 if no other scale promises a fifth less work, or if a sample of a thousand has too few
// neighbors to tell. The boxes must be sound. The same boxes always give the same answer. It takes some milliseconds.
BulkFit bulk_fit(std::span<const core::Box> boxes, const BoxFacts& facts);

// The same in two steps, for boxes that are not in the host's memory: which boxes are in the sample, and the answer
// from these.
std::vector<std::uint32_t> boxes_to_fit_by(std::size_t count);
BulkFit bulk_fit_by_sample(const std::vector<core::Box>& sample, const BoxFacts& facts);

}  // namespace broadside::gpu
