// How a pipeline launches frames, waits for them, repeats them with larger buffers, and counts them as steps.
#include <algorithm>

#include "gpu/frame/pipeline_parts.hpp"

namespace broadside::gpu {

// A barrier of few blocks is faster. More than one block a multiprocessor pays if there is work for them, as there is
// if all pairs are tested at all levels.
LaunchShape Pipeline::Impl::frame_shape() const {
  LaunchShape shape = launch;
  if (view.body_count < kLeastBodiesForGrid && broad_view.start != Start::kNone)
    shape.blocks = std::min(shape.blocks, shape.multiprocessors);
  return shape;
}

// For a small frame. Levels that are tested during the vertex search cost no time, because idle warps test them. But if
// there are more pairs than the grid has large teams of warps, each with one warp more, it is better to test levels
// first: then each pair that remains gets more warps. The last frame that the host has seen says how many pairs there
// are. A large team is a quarter of a block where cells are looked up, and a block where two trees are descended.
bool Pipeline::Impl::levels_come_first(const LaunchShape& shape) const {
  if (view.levels == core::Levels::kFlat) return false;
  const std::uint64_t warps = shape.threads / 32;
  const std::uint64_t large = device_scene.has_cells() ? std::max<std::uint64_t>(1, warps / 4) : warps;
  return !view.has_vertex_stage || last.pairs * (large + 1) > shape.blocks * warps;
}

// Launches a frame after those under way.
core::Status Pipeline::Impl::launch_frame() {
  buffers.fill(view, frames.under_way());
  broad.fill(broad_view);
  if (is_confirmed_by_level0()) view.confirmed.items = view.pairs.items;
  const LaunchShape shape = frame_shape();
  return is_small_frame(view, broad_view.start) ? frames.launch(small_view(shape), shape)
                                                : frames.launch(grid_view(), shape);
}

SmallFrameView Pipeline::Impl::small_view(const LaunchShape& shape) const {
  SmallFrameView small{view};
  buffers.fill_small(small);
  small.ring_share = ring_share(view.body_count, shape);
  small.are_levels_first = levels_come_first(shape);
  return small;
}

GridFrameView Pipeline::Impl::grid_view() const {
  GridFrameView grid{view, broad_view};
  buffers.fill_grid(grid);
  return grid;
}

// Waits for the only frame under way.
core::Status Pipeline::Impl::wait_for_frame() {
  if (!has_digest) return frames.wait();
  // The host waits for the frame alone: the digest is added up while the host prepares the next launch.
  BROADSIDE_TRY(frame_end.set(stream));
  BROADSIDE_TRY(start_digest(view.next, steps + 1));
  return frame_end.wait("a frame");
}

// Called when the oldest frame is done. Returns false if its buffers were too small: they have grown, and the frame
// must be launched again from the state before it.
core::Result<bool> Pipeline::Impl::is_kept() {
  last = frames.oldest().counters;
  if (last.is_aborted == 0) return true;
  BROADSIDE_TRY(frames.clear());
  BROADSIDE_TRY(broad.grow(last));
  BROADSIDE_TRY(buffers.grow(last, is_confirmed_by_level0()));
  ++repeats;
  return false;
}

// Counts the oldest frame, which is kept, as a step.
void Pipeline::Impl::take_frame() {
  // What was put into the stream before this frame is done.
  take_digests();
  unsigned long long begin_ns = frames.oldest().begin_ns;
  for (std::size_t k = 0; k < core::kStageCount; ++k) {
    const unsigned long long end_ns = frames.oldest().stage_end_ns[k];
    times[k] = {core::kStageNames[k], static_cast<double>(end_ns - begin_ns) * 1e-9};
    begin_ns = end_ns;
  }
  frames.pop();
  buffers.advance();
  ++steps;
  pairs_tested += starts_at_level0() ? last.pairs : all_pairs;
  dt_s = static_cast<double>(view.dt_s);
}

// After an error, waits until no frame is under way: the device would use memory that this object may free now.
core::Status Pipeline::Impl::settled(core::Status status) {
  if (!status.ok()) (void)frames.clear();
  return status;
}

core::Status Pipeline::step(float dt_s) {
  impl_->view.dt_s = dt_s;
  return impl_->settled(impl_->run_alone());
}

core::Status Pipeline::Impl::run_alone() {
  has_digest = expects_digest();
  for (bool is_done = false; !is_done;) {
    BROADSIDE_TRY(launch_frame());
    BROADSIDE_TRY(wait_for_frame());
    const auto kept = is_kept();
    if (!kept.ok()) return kept.error();
    is_done = kept.value();
  }
  BROADSIDE_TRY(count_work());
  take_frame();
  return core::Done{};
}

core::Status Pipeline::run(float dt_s, std::uint64_t steps, const StepDone& step_done) {
  impl_->view.dt_s = dt_s;
  if (!impl_->work.is_asked()) return impl_->settled(impl_->run_ahead(steps, step_done));
  // Work is counted from what a frame left in memory, so no frame is launched ahead.
  bool goes_on = true;
  for (std::uint64_t k = 0; k < steps && goes_on; ++k) {
    BROADSIDE_TRY(step(dt_s));
    goes_on = step_done();
  }
  return core::Done{};
}

core::Status Pipeline::Impl::run_ahead(std::uint64_t steps_asked, const StepDone& step_done) {
  std::uint64_t end = steps + steps_asked;
  bool is_told = true;  // step_done is still to be called
  while (steps < end) {
    while (frames.under_way() < FrameQueue::kMost && steps + frames.under_way() < end) BROADSIDE_TRY(launch_frame());
    BROADSIDE_TRY(frames.wait());
    const auto kept = is_kept();
    if (!kept.ok()) return kept.error();
    if (!kept.value()) continue;
    take_frame();
    has_digest = false;
    if (is_told && !step_done()) {
      is_told = false;
      end = steps + frames.under_way();
    }
  }
  return core::Done{};
}

// Counts the work of the frame that was just computed, if work is to be counted.
core::Status Pipeline::Impl::count_work() {
  const BroadWorkView of_broad{broad_view, {}, view.boxes, view.body_count, view.counters};
  BROADSIDE_TRY(work.count_broad(of_broad, launch.multiprocessors, stream));
  if (is_confirmed_by_level0()) return core::Done{};
  return work.count_levels(view, broad_view.start, launch.multiprocessors, stream);
}

}  // namespace broadside::gpu
