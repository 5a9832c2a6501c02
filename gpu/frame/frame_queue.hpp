// Frames of one simulation in a stream, from their launch until the host has seen them.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/runtime/host_side.hpp"

namespace broadside::gpu {

// The host may launch a frame before it has seen how the one before ended, so the GPU goes from frame to frame without
// waiting for the host. A frame that comes after an aborted one does nothing.
class FrameQueue {
 public:
  // One frame runs and one waits. A third would make nothing faster, and more frames would have to be repeated after an
  // abort.
  static constexpr std::uint64_t kMost = 2;

  // Makes an empty queue. Others may use the stream too; it must exist for as long as this object is used.
  core::Status create(StreamHandle stream);
  // Launches a frame after those under way, which must be fewer than kMost. `frame` is a SmallFrameView or a
  // GridFrameView, complete except for its outcome. Returns at once.
  template <typename View>
  core::Status launch(View frame, const LaunchShape& shape);
  [[nodiscard]] std::uint64_t under_way() const { return launched_ - seen_; }

  // Waits until the oldest frame is done.
  [[nodiscard]] core::Status wait() const;
  // The outcome of the oldest frame; valid once it is done, until the next launch.
  [[nodiscard]] const Outcome& oldest() const { return outcomes_[seen_ % kMost]; }
  // Removes the oldest frame, which the host has seen.
  void pop() { ++seen_; }
  // Waits for all frames, and forgets them.
  core::Status clear();

 private:
  StreamHandle stream_ = nullptr;
  // Frames use these in turn.
  Mapped<Outcome, kMost> outcomes_;
  StreamMark ends_[kMost];
  std::uint64_t launched_ = 0;
  std::uint64_t seen_ = 0;
};

}  // namespace broadside::gpu
