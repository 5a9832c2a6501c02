#include "gpu/work/work_counter.hpp"

#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Status WorkCounter::reset() {
  has_broad_ = has_levels_ = false;
  BROADSIDE_TRY(counters_.reserve(1, "counts of work"));
  BROADSIDE_TRY(work_.reserve(1, "counts of work"));
  return work_.fill_bytes(0);
}

core::Status WorkCounter::count_broad(const BroadWorkView& view, std::uint32_t multiprocessors, StreamHandle stream) {
  if (!is_asked_ || !is_counted(view.broad.start)) return core::Done{};
  start_ = view.broad.start;
  has_broad_ = true;
  BroadWorkView own = view;
  own.work = work_.data();
  BROADSIDE_TRY(launch_broad_work(own, multiprocessors, stream));
  return wait_for_stream(stream, "counting the broad phase's work");
}

core::Status WorkCounter::count_levels(const FrameView& frame, Start start, std::uint32_t multiprocessors,
                                       StreamHandle stream) {
  if (!is_asked_) return core::Done{};
  has_levels_ = true;
  LevelWorkView view{frame, start, work_.data()};
  view.frame.confirmed = {};
  view.frame.counters = counters_.data();
  BROADSIDE_TRY(copy_on_device(counters_.data(), frame.counters, sizeof(Counters), stream));
  BROADSIDE_TRY(launch_level_work(view, multiprocessors, stream));
  return wait_for_stream(stream, "counting the levels' work");
}

void WorkCounter::tell(std::vector<core::Counter>& counters) const {
  std::vector<Work> work;
  if ((!has_broad_ && !has_levels_) || !work_.download(work, 1).ok()) return;
  if (has_broad_) counters.push_back({"broad: box tests", work[0].broad_tests});
  if (has_broad_ && (start_ == Start::kGrid || start_ == Start::kBulk || start_ == Start::kHash))
    counters.push_back({"broad: nodes visited", work[0].broad_nodes});
  if (has_levels_) counters.push_back({"level stage: box tests", work[0].level_tests});
}

}  // namespace broadside::gpu
