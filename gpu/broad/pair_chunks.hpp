// Finds the pairs of a search in chunks: share after share of the boxes looks for its partners among all, and what was
// found is handed on before the next share begins.
#pragma once

#include <functional>

#include "gpu/broad/box_search.hpp"

namespace broadside::gpu {

using ChunkConsumer = std::function<core::Status(const FoundPairs&)>;

// Chunks are as large as the search has room for. Shares grow and shrink by what the ones before have found; one whose
// pairs do not fit is searched again as two. An error says how much room one box alone would need. `launches` counts.
core::Status for_each_chunk(BoxSearch& search, const Stream& stream, const ChunkConsumer& take, std::uint64_t& launches,
                            const PairNames& names = {});

}  // namespace broadside::gpu
