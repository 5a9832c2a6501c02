// Times the stages of a frame, one after another. Times are added to those that are there.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "core/engine/dynamics.hpp"
#include "core/engine/stage.hpp"

namespace broadside::reference {

class StageClock {
 public:
  explicit StageClock(std::array<core::StageTime, core::kStageCount>& times) : times_(times), last_(Clock::now()) {}
  // Ends a stage: its time is the time since the end of the stage before.
  void lap(core::Stage stage) {
    const auto now = Clock::now();
    core::StageTime& time = times_[static_cast<std::size_t>(stage)];
    time = {core::name_of(stage), time.seconds + std::chrono::duration<double>(now - last_).count()};
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::array<core::StageTime, core::kStageCount>& times_;
  Clock::time_point last_;
};

}  // namespace broadside::reference
