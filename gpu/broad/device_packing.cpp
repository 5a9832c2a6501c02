#include "gpu/broad/device_packing.hpp"

#include "gpu/broad/searched_boxes.hpp"

namespace broadside::gpu {

BoxFacts facts_of(const BoxMeasure& measure, std::uint32_t count) {
  BoxFacts facts;
  facts.count = count;
  if (count == 0) return facts;
  facts.largest_side_m = from_ordered_bits(measure.largest_side);
  facts.coordinate_range_m = from_ordered_bits(measure.coordinate_range);
  for (int k = 0; k < 3; ++k) {
    facts.domain.min[k] = from_ordered_bits(measure.low[k]);
    facts.domain.max[k] = from_ordered_bits(measure.high[k]);
  }
  facts.low_corner = facts.domain.min;
  return facts;
}

// Copies from the host do not go through the stream, so they are waited for before the stream's work begins.
core::Status DevicePacking::reserve(std::span<const std::uint8_t> is_static) {
  const BoxMeasure of_none[2];
  BROADSIDE_TRY(flags_.upload(is_static, "flags of static boxes"));
  BROADSIDE_TRY(measures_.upload(of_none, "measures of boxes"));
  BROADSIDE_TRY(measured_.allocate());
  BROADSIDE_TRY(wait_for_device("copying flags of static boxes"));
  has_flags_ = true;
  return core::Done{};
}

core::Status DevicePacking::wait_behind(const core::DeviceBoxes& given, const Stream& stream) {
  if (given.count == 0 || !given.is_behind_stream) return core::Done{};
  BROADSIDE_TRY(written_.set(static_cast<StreamHandle>(given.stream)));
  return written_.hold_back(stream.get());
}

core::Result<std::vector<core::Box>> DevicePacking::gather(const core::DeviceBoxes& given,
                                                           std::span<const std::uint32_t> which, const Stream& stream) {
  std::vector<core::Box> boxes;
  if (which.empty()) return boxes;
  BROADSIDE_TRY(which_.upload(which, "numbers of boxes"));
  BROADSIDE_TRY(gathered_.reserve(which.size(), "some of the boxes"));
  BROADSIDE_TRY(wait_for_device("copying numbers of boxes"));
  BROADSIDE_TRY(wait_behind(given, stream));
  GatherView view;
  view.count = static_cast<std::uint32_t>(which.size());
  view.which = which_.data();
  view.given = given.data;
  view.gathered = gathered_.data();
  BROADSIDE_TRY(launch_gather(view, stream.get()));
  BROADSIDE_TRY(stream.wait("looking at some of the boxes"));
  BROADSIDE_TRY(gathered_.download(boxes, which.size()));
  return boxes;
}

core::Result<BoxFacts> DevicePacking::pack(const core::DeviceBoxes& given, std::span<const std::uint8_t> is_static,
                                           PackedBox* to, const Stream& stream) {
  if (!has_flags_) BROADSIDE_TRY(reserve(is_static));
  BROADSIDE_TRY(wait_behind(given, stream));
  BoxMeasure* const measure = measures_.data() + 1;
  BROADSIDE_TRY(copy_on_device(measure, measures_.data(), sizeof *measure, stream.get()));
  PackView view;
  view.count = static_cast<std::uint32_t>(given.count);
  view.given = given.data;
  view.is_static = flags_.data();
  view.packed = to;
  view.measure = measure;
  BROADSIDE_TRY(launch_pack(view, stream.get()));
  BROADSIDE_TRY(start_copy_to_host(&measured_[0], measure, sizeof *measure, stream.get()));
  BROADSIDE_TRY(stream.wait("packing boxes"));
  if (measured_[0].first_bad < given.count) return bad_box(measured_[0].first_bad);
  return facts_of(measured_[0], view.count);
}

}  // namespace broadside::gpu
