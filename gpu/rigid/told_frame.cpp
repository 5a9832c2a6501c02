#include "gpu/rigid/told_frame.hpp"

#include <vector>

#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {
namespace {

core::DeviceFrame columns_of(const RigidLeft& left, const ToldBody* bodies, const core::ContactPoint* points,
                             std::uint64_t point_count) {
  const std::uint64_t n = left.bodies.state.size();
  constexpr std::size_t kBody = sizeof(ToldBody);
  constexpr std::size_t kPoint = sizeof(core::ContactPoint);
  core::DeviceFrame frame;
  frame.columns = {
      {"body/position", &bodies->position, n, 3, kBody, true},
      {"body/orientation", &bodies->orientation, n, 4, kBody, true},
      {"body/velocity", &bodies->velocity, n, 3, kBody, true},
      {"body/angular_velocity", &bodies->angular_velocity, n, 3, kBody, true},
      {"pairs/pairs", left.pairs.data(), left.pair_count, 2, sizeof(core::Pair), false},
      {"confirmed/pairs", left.buffers.confirmed().data(), left.counts.confirmed, 2, sizeof(core::Pair), false},
      {"point/a", &points->a, point_count, 1, kPoint, false},
      {"point/b", &points->b, point_count, 1, kPoint, false},
      {"point/point", &points->point, point_count, 3, kPoint, true},
      {"point/normal", &points->normal, point_count, 3, kPoint, true},
      {"point/gap", &points->gap_m, point_count, 1, kPoint, true},
      {"point/impulse", &points->impulse, point_count, 3, kPoint, true},
      {"point/feature", &points->feature, point_count, 1, kPoint, false}};
  return frame;
}

}  // namespace

core::Result<core::DeviceFrame> ToldFrame::tell(const RigidLeft& left, StreamHandle stream) {
  BROADSIDE_TRY(bodies_.reserve(left.bodies.state.size(), "states"));
  BROADSIDE_TRY(points_.reserve(4 * left.counts.patches, "points"));
  BROADSIDE_TRY(point_count_.reserve(1, "points"));
  BROADSIDE_TRY(point_count_.fill_bytes(0));
  BROADSIDE_TRY(mass_.upload(left.bodies.mass, "masses"));
  BROADSIDE_TRY(static_spin_.upload(left.bodies.static_spin, "masses"));
  BROADSIDE_TRY(wait_for_device("the columns of a frame"));
  ToldView view;
  view.body_count = static_cast<std::uint32_t>(left.bodies.state.size());
  view.patch_count = left.counts.patches;
  view.state = left.buffers.before().data();
  view.detected = left.buffers.after().data();
  view.mass = mass_.data();
  view.static_spin = static_spin_.data();
  view.patches = left.buffers.patches().data();
  view.impulses = left.buffers.impulses().data();
  view.bodies = bodies_.data();
  view.points = points_.data();
  view.point_count = point_count_.data();
  BROADSIDE_TRY(launch_told(view, stream));
  BROADSIDE_TRY(wait_for_stream(stream, "the columns of a frame"));
  std::vector<std::uint32_t> point_count;
  BROADSIDE_TRY(point_count_.download(point_count, 1));
  core::DeviceFrame frame = columns_of(left, bodies_.data(), points_.data(), point_count[0]);
  auto device = current_device();
  if (!device.ok()) return device.error();
  frame.device = device.value();
  return frame;
}

}  // namespace broadside::gpu
