// How much larger than the largest box the largest cells of bulk pairs are made.
//
// A box lies in cells of its own size to four times that, since bulk pairs have even levels alone. Whether most boxes
// of a set are little or much shorter than their cells depends on how their sizes compare with the largest one. Larger
// cells move all levels together. What that does to the number of tests is not to be told from the sizes alone, so it
// is counted in a sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "gpu/broad/broad_buffers.hpp"

namespace broadside::gpu {

// From 1 to below 4; 1 where nothing else promises a fifth less work, or where a sample of a thousand is too thin to
// tell. Sound boxes; the same boxes give the same answer. It takes some milliseconds.
float fitted_cell_scale(std::span<const core::Box> boxes, const BoxFacts& facts);

// The same where the boxes are elsewhere: which of them are looked at, and the answer from these.
std::vector<std::uint32_t> boxes_to_fit_by(std::size_t count);
float cell_scale_by_sample(const std::vector<core::Box>& sample, const BoxFacts& facts);

}  // namespace broadside::gpu
