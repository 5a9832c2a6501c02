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
  // Frames of which the longest dataset has something; more than frame_count() when a writer was cut off.
  std::uint64_t frames_begun = 0;

  [[nodiscard]] std::uint64_t frame_count() const { return steps.size(); }
  // Rows that a dataset has for the frames 0 .. frame - 1.
  [[nodiscard]] std::uint64_t rows_before(const Column& column, std::uint64_t frame) const;
};

FrameIndex read_index(Hdf5Source& source, std::uint32_t groups);

// A writer that was cut off may leave some datasets longer than others: a frame counts when its step was written, which
// is last, and every dataset reaches it. array belongs to column; call once per dataset that has rows.
void keep_reached(FrameIndex& index, const Column& column, const OpenArray& array);
void keep_complete(FrameIndex& index);

// Steps rise, offsets start with 0 and never fall, and arrays that go together have as many rows.
void check_order(const FrameIndex& index, Hdf5Source& source);

}  // namespace broadside::core
