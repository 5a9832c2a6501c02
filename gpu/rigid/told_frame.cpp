#include "gpu/rigid/told_frame.hpp"

#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/runtime/device_choice.hpp"

namespace broadside::gpu {
namespace {

template <typename T>
core::DeviceColumn column(std::string_view path, const T* rows, std::uint64_t count) {
  constexpr std::size_t kWords = sizeof(T) / sizeof(float);  // NOLINT(bugprone-sizeof-expression): of a float one
  return {path, rows, count, kWords, sizeof(T), !std::is_integral_v<T> && !std::is_same_v<T, core::Pair>};
}

// Rows of device memory.
template <typename T>
struct Rows {
  const T* data = nullptr;
  std::uint64_t count = 0;
};

core::DeviceFrame columns_of(std::uint64_t n, Rows<core::Pair> pairs, Rows<core::Pair> confirmed, const ToldView& told,
                             std::uint64_t points) {
  core::DeviceFrame frame;
  frame.columns = {column("body/position", told.bodies.position, n),
                   column("body/orientation", told.bodies.orientation, n),
                   column("body/velocity", told.bodies.velocity, n),
                   column("body/angular_velocity", told.bodies.angular_velocity, n),
                   column("pairs/pairs", pairs.data, pairs.count),
                   column("confirmed/pairs", confirmed.data, confirmed.count),
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

void ToldFrame::fill_columns(ToldView& view) const {
  view.bodies = {bodies_.position.data(), bodies_.orientation.data(), bodies_.velocity.data(),
                 bodies_.angular_velocity.data()};
  view.points = {points_.a.data(),   points_.b.data(),       points_.point.data(),  points_.normal.data(),
                 points_.gap.data(), points_.impulse.data(), points_.feature.data()};
}

ToldView ToldFrame::view_of(const RigidLeft& left) const {
  ToldView view;
  view.body_count = static_cast<std::uint32_t>(left.bodies.state.size());
  view.patch_count = left.counts.patches;
  view.state = left.state.data();
  view.detected = left.detected.data();
  view.mass = mass_.data();
  view.static_spin = static_spin_.data();
  view.patches = left.patches.data();
  view.impulses = left.impulses.data();
  fill_columns(view);
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
  return remember(columns_of(left.bodies.state.size(), {left.pairs.data(), left.pair_count},
                             {left.confirmed.data(), left.counts.confirmed}, view, told_points_[0]),
                  step);
}

core::Result<core::DeviceFrame> ToldFrame::remember(core::DeviceFrame frame, std::uint64_t step) {
  auto device = current_device();
  if (!device.ok()) return device.error();
  frame_ = std::move(frame);
  frame_.device = device.value();
  is_told_ = true;
  step_ = step;
  return frame_;
}

core::Status ToldFrame::upload_points(const std::vector<core::ContactPoint>& points) {
  const auto upload = [&](auto& to, auto member) -> core::Status {
    std::vector<std::remove_cvref_t<decltype(points[0].*member)>> rows;
    rows.reserve(points.size());
    for (const core::ContactPoint& p : points) rows.push_back(p.*member);
    return to.upload(rows, "points");
  };
  BROADSIDE_TRY(reserve_points(points.size()));
  BROADSIDE_TRY(upload(points_.a, &core::ContactPoint::a));
  BROADSIDE_TRY(upload(points_.b, &core::ContactPoint::b));
  BROADSIDE_TRY(upload(points_.point, &core::ContactPoint::point));
  BROADSIDE_TRY(upload(points_.normal, &core::ContactPoint::normal));
  BROADSIDE_TRY(upload(points_.gap, &core::ContactPoint::gap_m));
  BROADSIDE_TRY(upload(points_.impulse, &core::ContactPoint::impulse));
  return upload(points_.feature, &core::ContactPoint::feature);
}

core::Result<core::DeviceFrame> ToldFrame::upload(const core::FrameRecord& frame, std::uint64_t step) {
  if (is_told_ && step == step_) return frame_;
  is_told_ = false;
  BROADSIDE_TRY(bodies_.position.upload(frame.position, "states"));
  BROADSIDE_TRY(bodies_.orientation.upload(frame.orientation, "states"));
  BROADSIDE_TRY(bodies_.velocity.upload(frame.velocity, "states"));
  BROADSIDE_TRY(bodies_.angular_velocity.upload(frame.angular_velocity, "states"));
  BROADSIDE_TRY(pairs_.upload(frame.pairs, "pairs"));
  BROADSIDE_TRY(confirmed_.upload(frame.confirmed, "pairs"));
  BROADSIDE_TRY(upload_points(frame.points));
  ToldView view;
  fill_columns(view);
  return remember(columns_of(frame.position.size(), {pairs_.data(), frame.pairs.size()},
                             {confirmed_.data(), frame.confirmed.size()}, view, frame.points.size()),
                  step);
}

}  // namespace broadside::gpu
