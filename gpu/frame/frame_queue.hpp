// Frames of one simulation in a stream, from their launch until the host has seen them.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/runtime/host_side.hpp"

namespace broadside::gpu {

// The host may launch a frame before it has seen the one before, and the GPU goes from one to the next without it. A
// frame behind one that was aborted does nothing.
class FrameQueue {
 public:
  // One runs and one waits. With a third nothing is faster, and more has to be done again after an abort.
  static constexpr std::uint64_t kMost = 2;

  // Empty. The stream, which others may use too, outlives this object's use.
  core::Status create(StreamHandle stream);
  // Behind those under way, fewer than kMost; `frame`, a SmallFrameView or a GridFrameView, is complete but for its
  // outcomes. Returns at once.
  template <typename View>
  core::Status launch(View frame, const LaunchShape& shape);
  [[nodiscard]] std::uint64_t under_way() const { return launched_ - seen_; }

  // Until the oldest frame is done.
  [[nodiscard]] core::Status wait() const;
  // Of the oldest frame, when it is done; until launch.
  [[nodiscard]] const Outcome& oldest() const { return outcomes_[seen_ % kMost]; }
  // The oldest frame was seen.
  void pop() { ++seen_; }
  // Waits for all, and forgets them.
  core::Status clear();

 private:
  StreamHandle stream_ = nullptr;
  // By turns.
  Mapped<Outcome, kMost> outcomes_;
  StreamMark ends_[kMost];
  std::uint64_t launched_ = 0;
  std::uint64_t seen_ = 0;
};

}  // namespace broadside::gpu
