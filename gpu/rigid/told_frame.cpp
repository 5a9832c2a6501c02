#include "gpu/rigid/told_frame.hpp"

#include <string_view>
#include <type_traits>

#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {
namespace {

template <typename T>
core::DeviceColumn column(std::string_view path, const T* rows, std::uint64_t count) {
  constexpr std::size_t kWords = sizeof(T) / sizeof(float);  // NOLINT(bugprone-sizeof-expression): of a float one
  return {path, rows, count, kWords, sizeof(T), !std::is_integral_v<T> && !std::is_same_v<T, core::Pair>};
}

core::DeviceFrame columns_of(const RigidLeft& left, const ToldView& told, std::uint64_t points) {
  const std::uint64_t n = left.bodies.state.size();
  core::DeviceFrame frame;
  frame.columns = {column("body/position", told.bodies.position, n),
                   column("body/orientation", told.bodies.orientation, n),
                   column("body/velocity", told.bodies.velocity, n),
                   column("body/angular_velocity", told.bodies.angular_velocity, n),
                   column("pairs/pairs", left.pairs.data(), left.pair_count),
                   column("confirmed/pairs", left.buffers.confirmed().data(), left.counts.confirmed),
                   column("point/a", told.points.a, points),
                   column("point/b", told.points.b, points),
                   column("point/point", told.points.point, points),
                   column("point/normal", told.points.normal, points),
                   column("point/gap", told.points.gap_m, points),
                   column("point/impulse", told.points.impulse, points),
                   column("point/feature", told.points.feature, points)};
  return frame;
}

}  // namespace

core::Status ToldFrame::prepare(const RigidLeft& left) {
  const std::size_t n = left.bodies.state.size();
  BROADSIDE_TRY(bodies_.position.reserve(n, "states"));
  BROADSIDE_TRY(bodies_.orientation.reserve(n, "states"));
  BROADSIDE_TRY(bodies_.velocity.reserve(n, "states"));
  BROADSIDE_TRY(bodies_.angular_velocity.reserve(n, "states"));
  BROADSIDE_TRY(mass_.upload(left.bodies.mass, "masses"));
  BROADSIDE_TRY(static_spin_.upload(left.bodies.static_spin, "masses"));
  BROADSIDE_TRY(words_.reserve(2, "points"));
  BROADSIDE_TRY(words_.fill_bytes(0));
  BROADSIDE_TRY(told_points_.allocate());
  BROADSIDE_TRY(wait_for_device("the columns of a frame"));
  is_ready_ = true;
  return core::Done{};
}

// Room for more than is asked for, because memory that grows a little in every step costs more than the columns.
core::Status ToldFrame::reserve_points(std::size_t points) {
  if (points_.a.data() != nullptr && points <= points_.a.capacity()) return core::Done{};
  points += points / 2;
  BROADSIDE_TRY(points_.b.reserve(points, "points"));
  BROADSIDE_TRY(points_.point.reserve(points, "points"));
  BROADSIDE_TRY(points_.normal.reserve(points, "points"));
  BROADSIDE_TRY(points_.gap.reserve(points, "points"));
  BROADSIDE_TRY(points_.impulse.reserve(points, "points"));
  BROADSIDE_TRY(points_.feature.reserve(points, "points"));
  return points_.a.reserve(points, "points");  // last: its size says that all have room
}

ToldView ToldFrame::view_of(const RigidLeft& left) const {
  ToldView view;
  view.body_count = static_cast<std::uint32_t>(left.bodies.state.size());
  view.patch_count = left.counts.patches;
  view.state = left.buffers.before().data();
  view.detected = left.buffers.after().data();
  view.mass = mass_.data();
  view.static_spin = static_spin_.data();
  view.patches = left.buffers.patches().data();
  view.impulses = left.buffers.impulses().data();
  view.bodies = {bodies_.position.data(), bodies_.orientation.data(), bodies_.velocity.data(),
                 bodies_.angular_velocity.data()};
  view.points = {points_.a.data(),   points_.b.data(),       points_.point.data(),  points_.normal.data(),
                 points_.gap.data(), points_.impulse.data(), points_.feature.data()};
  view.point_count = words_.data();
  view.blocks_done = words_.data() + 1;
  view.told_points = told_points_.device(0);
  return view;
}

core::Result<core::DeviceFrame> ToldFrame::tell(const RigidLeft& left, std::uint64_t step, StreamHandle stream) {
  if (is_told_ && step == step_) return frame_;
  is_told_ = false;
  if (!is_ready_) BROADSIDE_TRY(prepare(left));
  BROADSIDE_TRY(reserve_points(4 * left.counts.patches));
  const ToldView view = view_of(left);
  BROADSIDE_TRY(launch_told(view, stream));
  BROADSIDE_TRY(wait_for_stream(stream, "the columns of a frame"));
  auto device = current_device();
  if (!device.ok()) return device.error();
  frame_ = columns_of(left, view, told_points_[0]);
  frame_.device = device.value();
  is_told_ = true;
  step_ = step;
  return frame_;
}

}  // namespace broadside::gpu
