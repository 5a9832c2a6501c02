#include "bench/record/frame_taker.hpp"

#include <utility>

namespace broadside::bench {

using Taken = core::Result<std::optional<core::FrameRecord>>;

FrameTaker::FrameTaker(core::Dynamics& dynamics, core::RecordLevel level, std::uint64_t steps_before, float dt_s)
    : dynamics_(dynamics),
      copies_(dynamic_cast<core::FrameCopies*>(&dynamics)),
      level_(level),
      steps_before_(steps_before),
      dt_s_(static_cast<double>(dt_s)) {}

Taken FrameTaker::take() {
  if (copies_ == nullptr) {
    core::FrameRecord frame;
    if (core::Status s = dynamics_.read_back(frame, level_); !s) return s.error();
    place(frame);
    return std::optional(std::move(frame));
  }
  const bool had_one = std::exchange(is_under_way_, true);
  if (core::Status s = copies_->start_copy(level_); !s) return s.error();
  return had_one ? finish() : Taken(std::nullopt);
}

Taken FrameTaker::rest() {
  return std::exchange(is_under_way_, false) ? finish() : Taken(std::nullopt);
}

Taken FrameTaker::finish() {
  core::FrameRecord frame;
  if (core::Status s = copies_->finish_copy(frame); !s) return s.error();
  place(frame);
  return std::optional(std::move(frame));
}

// An engine that resumed from a trace counts its steps from there, and gives once-per-run data again.
void FrameTaker::place(core::FrameRecord& frame) const {
  if (steps_before_ == 0) return;
  frame.shape_of_body.clear();
  frame.body_octree_boxes.clear();
  frame.leaf_of_vertex.clear();
  frame.step += steps_before_;
  frame.time_s = static_cast<double>(frame.step) * dt_s_;
}

}  // namespace broadside::bench
