// Takes frames from a running simulation: at once, or one frame late where the engine copies a frame while it steps on.
#pragma once

#include <cstdint>
#include <optional>

#include "core/engine/dynamics.hpp"
#include "core/engine/frame_copies.hpp"
#include "core/result.hpp"

namespace broadside::bench {

class FrameTaker {
 public:
  // steps_before: the steps of the run that the engine did not make itself, because it resumed from a trace.
  FrameTaker(core::Dynamics& dynamics, core::RecordLevel level, std::uint64_t steps_before, float dt_s);

  // Called after a step whose frame is wanted. Returns a frame that is ready: that of this step, or of the wanted step
  // before it.
  core::Result<std::optional<core::FrameRecord>> take();
  // The last wanted frame, if take() did not return it yet.
  core::Result<std::optional<core::FrameRecord>> rest();

 private:
  core::Result<std::optional<core::FrameRecord>> finish();
  void place(core::FrameRecord& frame) const;

  core::Dynamics& dynamics_;
  core::FrameCopies* copies_;
  core::RecordLevel level_;
  std::uint64_t steps_before_;
  double dt_s_;
  bool is_under_way_ = false;
};

}  // namespace broadside::bench
