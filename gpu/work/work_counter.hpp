// Counts the work of frames where somebody asked: figures that are equal on every machine.
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

  // At load, before the device is waited for: nothing was done yet.
  core::Status reset();

  // After a frame or a search that was not aborted, before the next. They do nothing before ask(), and wait for the
  // device.
  core::Status count_broad(const BroadWorkView& view, std::uint32_t multiprocessors, StreamHandle stream);
  core::Status count_levels(const FrameView& frame, Start start, std::uint32_t multiprocessors, StreamHandle stream);

  // Behind the others, what was counted. Waits.
  void tell(std::vector<core::Counter>& counters) const;

 private:
  bool is_asked_ = false;
  Start start_ = Start::kNone;
  bool has_broad_ = false;
  bool has_levels_ = false;
  DeviceBuffer<Work> work_;          // since load
  DeviceBuffer<Counters> counters_;  // of a frame, to be written to
};

}  // namespace broadside::gpu
