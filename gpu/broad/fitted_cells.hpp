// How much larger than the largest box the largest cells of bulk pairs are made, and how many lanes look for the
// partners of a box.
//
// A box lies in cells of its own size to four times that, since bulk pairs have even levels alone. Whether most boxes
// of a set are little or much shorter than their cells depends on how their sizes compare with the largest one. Larger
// cells move all levels together. What that does to the number of tests is not to be told from the sizes alone, so it
// is counted in a sample.
//
// A warp is done when the slowest of its lanes is, and all warps when the slowest of them is. Boxes that lie together
// in the order lie together in space, so a warp in a crowd has all the work. Where boxes are so few that most warps
// have only one turn, four lanes a box share that work out to more warps. What they can share is a row of cells: where
// its entries are few, most lanes would wait. There cells are halved along x too: a row of them is one run of entries,
// which then ends nearer to the box.
//
// A box looks for partners on its own level and on all coarser ones that have boxes. Where sizes go over many octaves
// and few boxes are on each level, most of what it looks at are empty rows of cells: then levels are four octaves
// apart.
//
// Where most of what a box looks at is no partner, groups of neighboring boxes are searched instead of cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "gpu/broad/broad_buffers.hpp"

namespace broadside::gpu {

// Cells are scaled by 1 where nothing else promises a fifth less work, or where a sample of a thousand is too thin to
// tell. Sound boxes; the same boxes give the same answer. It takes some milliseconds.
BulkFit bulk_fit(std::span<const core::Box> boxes, const BoxFacts& facts);

// The same where the boxes are elsewhere: which of them are looked at, and the answer from these.
std::vector<std::uint32_t> boxes_to_fit_by(std::size_t count);
BulkFit bulk_fit_by_sample(const std::vector<core::Box>& sample, const BoxFacts& facts);

}  // namespace broadside::gpu
