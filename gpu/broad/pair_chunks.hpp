// Finds the pairs of a search in chunks. One share of the boxes after another looks for its partners among all boxes,
// and its pairs are handed on before the next share begins.
#pragma once

#include <functional>

#include "gpu/broad/box_search.hpp"

namespace broadside::gpu {

using ChunkConsumer = std::function<core::Status(const FoundPairs&)>;

// Chunks are as large as the search has room for. The size of a share follows from what the share before has found; a
// share whose pairs do not fit is searched again as a smaller one. An error says how much room one box alone would
// need. `launches` grows by one with each launch.
core::Status for_each_chunk(BoxSearch& search, const Stream& stream, const ChunkConsumer& take, std::uint64_t& launches,
                            const PairNames& names = {});

}  // namespace broadside::gpu
