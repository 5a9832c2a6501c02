// The launch that finds the pairs of moving boxes with standing ones, whose table is kept from frame to frame.
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

// Which cells of one coarse size have standing boxes in them. Each cell has a bit, which several cells of the world may
// share. In a large world most moving boxes are near no standing box, and need not be searched further.
struct StandingCells {
  std::uint32_t* words = nullptr;  // [word_mask + 1], a power of two of them; null: every cell may have some
  std::uint32_t word_mask = 0;
  float cells_per_m = 0.0F;
  core::Box bounds;  // of all standing boxes
};

struct MarkView {
  const PackedBox* boxes = nullptr;  // none is longer than a cell
  std::uint32_t count = 0;
  StandingCells cells;  // words must be zero before the launch
};
// Asynchronous.
core::Status launch_mark(const MarkView& view, StreamHandle stream);

struct CrossView {
  BulkView standing;                          // their table, in order
  const PackedBox* standing_boxes = nullptr;  // low_tag = the caller's number, as in moving_boxes
  StandingCells cells;
  const PackedBox* moving_boxes = nullptr;
  std::uint32_t count = 0;              // of moving boxes
  std::uint32_t* near = nullptr;        // [count] moving boxes that may have partners
  std::uint32_t* near_count = nullptr;  // how many; zero between frames
  // Already has the pairs of moving boxes with each other; the pairs with standing ones are appended.
  AppendView<core::Pair> pairs;
  Counters* counters = nullptr;
  unsigned long long* barrier = nullptr;
  Outcome* outcome = nullptr;
};

core::Result<LaunchShape> cross_launch_shape();
// Asynchronous.
core::Status launch_cross(const CrossView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
