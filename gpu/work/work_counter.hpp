// Counts the work of frames if ask() was called. The counts are the same on every machine.
#pragma once

#include <vector>

#include "core/engine/counter.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/work/work_view.hpp"

namespace broadside::gpu {

class WorkCounter {
 public:
  void ask() { is_asked_ = true; }
  [[nodiscard]] bool is_asked() const { return is_asked_; }

  // Sets the counts to zero. Call it at load, before waiting for the device.
  core::Status reset();

  // Call these after a frame or a search that was not aborted, before the next one. They wait for the device, and do
  // nothing unless ask() was called.
  core::Status count_broad(const BroadWorkView& view, std::uint32_t multiprocessors, StreamHandle stream);
  core::Status count_levels(const FrameView& frame, Start start, std::uint32_t multiprocessors, StreamHandle stream);

  // Appends what was counted. Waits.
  void tell(std::vector<core::Counter>& counters) const;

 private:
  bool is_asked_ = false;
  Start start_ = Start::kNone;
  bool has_broad_ = false;
  bool has_levels_ = false;
  DeviceBuffer<Work> work_;          // sums since load
  DeviceBuffer<Counters> counters_;  // a copy of a frame's counters, to write to
};

}  // namespace broadside::gpu
