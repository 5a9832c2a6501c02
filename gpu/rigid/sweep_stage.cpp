#include "gpu/rigid/sweep_stage.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/engine/device_boxes.hpp"
#include "core/method/rigid/sweep.hpp"

namespace broadside::gpu {

core::Status SweepStage::load(const core::RigidBodies& bodies) {
  auto shape = swept_launch_shape();
  if (!shape.ok()) return shape.error();
  shape_ = shape.value();
  thinnest_m_ = std::numeric_limits<float>::infinity();
  for (const core::RigidShape& s : bodies.shapes) thinnest_m_ = std::min(thinnest_m_, s.half_thickness_m);
  is_static_.assign(bodies.is_static.begin(), bodies.is_static.end());
  finder_ = std::make_unique<PairFinder>(PairFinderOptions{});
  has_boxes_ = false;
  stopped_ = 0;
  const std::size_t n = bodies.count();
  BROADSIDE_TRY(length_m_.reserve(n, "ways"));
  BROADSIDE_TRY(boxes_.reserve(n, "ways"));
  BROADSIDE_TRY(parts_.reserve(n, "ways"));
  BROADSIDE_TRY(next_parts_.reserve(n, "ways"));
  BROADSIDE_TRY(is_changed_.reserve(n, "ways"));
  return counts_.reserve(1, "counters");
}

core::Result<SweptCounts> SweepStage::counts() const {
  std::vector<SweptCounts> counts;
  BROADSIDE_TRY(counts_.download(counts, 1));
  return counts.front();
}

core::Status SweepStage::find_pairs(SweptView& view) {
  static_assert(sizeof(core::Box) == 6 * sizeof(float), "as core::DeviceBoxes has them");
  const core::DeviceBoxes boxes{&view.boxes->min.x, view.bodies.body_count, false, nullptr};
  BROADSIDE_TRY(has_boxes_ ? finder_->update_on_device(boxes) : finder_->load_on_device(boxes, is_static_));
  has_boxes_ = true;
  BROADSIDE_TRY(finder_->find());
  const auto found = finder_->pairs_on_device();
  if (!found.ok()) return found.error();
  view.pairs = found.value().data;
  view.pair_count = found.value().count;
  return core::Done{};
}

core::Status SweepStage::stop_short(const ContactView& frame, core::RigidState* after, StreamHandle stream) {
  BROADSIDE_TRY(counts_.fill_bytes(0));
  BROADSIDE_TRY(wait_for_device("clearing the counters of fast bodies"));
  SweptView view;
  view.bodies = frame;
  view.after = after;
  view.length_m = length_m_.data();
  view.boxes = boxes_.data();
  view.parts = parts_.data();
  view.next_parts = next_parts_.data();
  view.is_changed = is_changed_.data();
  view.counts = counts_.data();
  BROADSIDE_TRY(launch_ways(view, stream));
  BROADSIDE_TRY(wait_for_stream(stream, "following fast bodies"));
  const auto ways = counts();
  if (!ways.ok()) return ways.error();
  if (!(2.0F * std::bit_cast<float>(ways.value().longest) > core::swept_depth_m(thinnest_m_))) return core::Done{};
  BROADSIDE_TRY(find_pairs(view));
  BROADSIDE_TRY(launch_stop_short(view, shape_, stream));
  BROADSIDE_TRY(wait_for_stream(stream, "the sweep of bodies"));
  const auto done = counts();
  if (!done.ok()) return done.error();
  stopped_ += done.value().stopped;
  return core::Done{};
}

std::uint64_t SweepStage::bytes() const {
  return length_m_.bytes() + boxes_.bytes() + parts_.bytes() + next_parts_.bytes() + is_changed_.bytes() +
         counts_.bytes();
}

}  // namespace broadside::gpu
