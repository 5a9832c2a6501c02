#include "gpu/frame/frame_queue.hpp"

#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Status FrameQueue::create(StreamHandle stream) {
  stream_ = stream;
  launched_ = seen_ = 0;
  return outcomes_.allocate();
}

template <typename View>
core::Status FrameQueue::launch(View frame, const LaunchShape& shape) {
  frame.outcome = outcomes_.device(launched_ % kMost);
  frame.is_behind_unseen = under_way() != 0;
  // Marks the end of the frame before this one. If no frame comes after, the host waits for the whole stream instead.
  if (under_way() != 0) BROADSIDE_TRY(ends_[(launched_ - 1) % kMost].set(stream_));
  BROADSIDE_TRY(launch_frame(frame, shape, stream_));
  ++launched_;
  return core::Done{};
}

template core::Status FrameQueue::launch(SmallFrameView frame, const LaunchShape& shape);
template core::Status FrameQueue::launch(GridFrameView frame, const LaunchShape& shape);

core::Status FrameQueue::wait() const {
  if (under_way() == 1) return wait_for_stream(stream_, "a frame");
  return ends_[seen_ % kMost].wait("a frame");
}

core::Status FrameQueue::clear() {
  seen_ = launched_;
  return wait_for_stream(stream_, "frames under way");
}

}  // namespace broadside::gpu
