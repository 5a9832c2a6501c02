// Launches that count what the stages of a frame test. frame_kernel.hpp's rules; work_kernel.cu implements them on
// CUDA, on_host/work_on_host.cpp with fibers.
#pragma once

#include "gpu/frame/frame_kernel.hpp"

namespace broadside::gpu {

// Sums of integers over pairs of boxes and visited cells: neither the order of threads nor how many there are shows.
struct Work {
  unsigned long long broad_tests = 0;  // pairs of body boxes, rounded ones where those are tested first
  unsigned long long broad_nodes = 0;  // runs of cells that a box looked into
  unsigned long long level_tests = 0;  // pairs of boxes of body octrees, empty ones included
  unsigned long long pairs = 0;        // that the broad phase found again
};

// Whether the work of this start can be counted.
inline bool is_counted(Start start) {
  return start != Start::kNone;
}

// Runs the search of the broad phase again over what a frame left on the device, finding into nothing. Asynchronous.
struct BroadWorkView {
  BroadView broad;
  BulkView bulk;  // where the start is Start::kBulk
  const PackedBox* boxes = nullptr;
  std::uint32_t box_count = 0;
  const Counters* counters = nullptr;  // of the frame
  Work* work = nullptr;
};
core::Status launch_broad_work(const BroadWorkView& view, std::uint32_t multiprocessors, StreamHandle stream);

// Likewise the levels below 0, over the pairs of the frame or, from the published start, over all. Its counters are a
// copy of the frame's: they are written.
struct LevelWorkView {
  FrameView frame;
  Start start = Start::kNone;
  Work* work = nullptr;
};
core::Status launch_level_work(const LevelWorkView& view, std::uint32_t multiprocessors, StreamHandle stream);

}  // namespace broadside::gpu
