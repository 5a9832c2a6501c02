// The digest of a frame that was recorded elsewhere, by core/trace/SCHEMA.md.
#pragma once

#include <cstdint>

#include "core/trace/frame.hpp"

namespace broadside::bench::python {

// The digest of states, confirmed pairs and contacts where the groups have states; else that of separations; else that
// of candidate pairs; 0 where they have none of these.
std::uint64_t digest_of(const core::FrameRecord& frame, std::uint32_t groups);

}  // namespace broadside::bench::python
