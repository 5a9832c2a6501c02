// Broad phases side by side on a stream of boxes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cell_spec.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// Sums over the frames; digest: the sum modulo 2^64 of the frames' pair digests, each mixed with its frame's number.
struct RaceRow {
  std::string label;
  std::uint64_t frames = 0;
  std::uint64_t boxes = 0;
  std::uint64_t pairs = 0;
  std::uint64_t raw = 0;
  std::uint64_t digest = 0;
  double update_s = 0.0;
  double find_s = 0.0;
  double read_back_s = 0.0;  // copies, the engine's own filter, canonical order
};

// frames: at most so many; 0 = all of the stream. Errors: unknown or malformed boxes, an engine without a broad phase
// or without its device, an engine that fails.
core::Result<std::vector<RaceRow>> race_boxes(const std::string& stream, const std::vector<CellSpec>& cells,
                                              std::uint32_t frames);

}  // namespace broadside::bench
