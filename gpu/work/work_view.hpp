// Launches that count what the stages of a frame test, by the rules of frame_kernel.hpp. work_kernel.cu implements them
// on CUDA, on_host/work_on_host.cpp with fibers.
#pragma once

#include "gpu/frame/frame_kernel.hpp"

namespace broadside::gpu {

// Sums of integers over pairs of boxes and visited cells, so they depend neither on the order of threads nor on their
// number.
struct Work {
  unsigned long long broad_tests = 0;  // pairs of body boxes; of rounded ones if these are tested first
  unsigned long long broad_nodes = 0;  // runs of cells that a box looked into
  unsigned long long level_tests = 0;  // pairs of boxes of body octrees, empty ones included
  unsigned long long pairs = 0;        // pairs that the repeated broad phase found
};

// Whether the work of this start can be counted.
inline bool is_counted(Start start) {
  return start != Start::kNone;
}

// Repeats the search of the broad phase over what a frame left on the device, without storing pairs. Asynchronous.
struct BroadWorkView {
  BroadView broad;
  BulkView bulk;  // where the start is Start::kBulk
  const PackedBox* boxes = nullptr;
  std::uint32_t box_count = 0;
  const Counters* counters = nullptr;  // of the frame
  Work* work = nullptr;
};
core::Status launch_broad_work(const BroadWorkView& view, std::uint32_t multiprocessors, StreamHandle stream);

// Does the same for the levels below 0, over the pairs of the frame or, with the published start, over all pairs. Its
// counters are a copy of the frame's, because the launch writes them.
struct LevelWorkView {
  FrameView frame;
  Start start = Start::kNone;
  Work* work = nullptr;
};
core::Status launch_level_work(const LevelWorkView& view, std::uint32_t multiprocessors, StreamHandle stream);

}  // namespace broadside::gpu
