// The launch that finds the pairs of moving boxes with standing ones, whose table stays from frame to frame.
#pragma once

#include <cstdint>

#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/broad/bulk_view.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// Which cells, of one coarse size, have standing boxes in them: a bit for each, several cells of the world may share
// one. Most moving boxes of a large world are near nothing that stands, and need look no further.
struct StandingCells {
  std::uint32_t* words = nullptr;  // [word_mask + 1], a power of two of them; null: every cell may have some
  std::uint32_t word_mask = 0;
  float cells_per_m = 0.0F;
  core::Box bounds;  // of all standing boxes
};

struct MarkView {
  const PackedBox* boxes = nullptr;  // no longer than a cell
  std::uint32_t count = 0;
  StandingCells cells;  // words are zero before
};
// Asynchronous.
core::Status launch_mark(const MarkView& view, StreamHandle stream);

struct CrossView {
  BulkView standing;                          // in order
  const PackedBox* standing_boxes = nullptr;  // low_tag = the caller's number, as of the others
  StandingCells cells;
  const PackedBox* moving_boxes = nullptr;
  std::uint32_t count = 0;              // of them
  std::uint32_t* near = nullptr;        // [count] moving boxes that may have partners
  std::uint32_t* near_count = nullptr;  // of them; zero between frames
  // Behind what is there: the pairs that the moving ones have among each other.
  AppendView<core::Pair> pairs;
  Counters* counters = nullptr;
  unsigned long long* barrier = nullptr;
  Outcome* outcome = nullptr;
};

core::Result<LaunchShape> cross_launch_shape();
// Asynchronous.
core::Status launch_cross(const CrossView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
