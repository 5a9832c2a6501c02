// Which frames a trace has, and which rows of its ragged arrays belong to each. Private to core/trace/*.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/hdf5_source.hpp"

namespace broadside::core {

struct FrameIndex {
  std::vector<std::uint64_t> steps;
  std::vector<double> times;
  std::vector<std::uint64_t> digests;
  std::map<Records, std::vector<std::uint64_t>> offsets;
  // Frames of which the longest dataset has some rows; more than frame_count() when a writer was interrupted.
  std::uint64_t frames_begun = 0;

  [[nodiscard]] std::uint64_t frame_count() const { return steps.size(); }
  // The number of rows in a dataset for the frames 0 .. frame - 1.
  [[nodiscard]] std::uint64_t rows_before(const Column& column, std::uint64_t frame) const;
};

FrameIndex read_index(Hdf5Source& source, std::uint32_t groups);

// A writer that was interrupted may leave some datasets longer than others. A frame counts when its step was written,
// which happens last, and every dataset reaches it. array belongs to column; call once per dataset that has rows.
void keep_reached(FrameIndex& index, const Column& column, const OpenArray& array);
void keep_complete(FrameIndex& index);

// Checks that steps rise, that offsets start with 0 and never decrease, and that arrays that belong together have
// equally many rows.
void check_order(const FrameIndex& index, Hdf5Source& source);

}  // namespace broadside::core
