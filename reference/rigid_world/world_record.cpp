#include "reference/rigid_world/world_record.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/method/frame_digest.hpp"

namespace broadside::reference {
namespace {

using plain::Vec;

core::Vec3 narrow(Vec v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
core::WideVec3 wide(Vec v) {
  return {v.x, v.y, v.z};
}
core::WideQuat wide(plain::Quaternion q) {
  return {q.w, q.x, q.y, q.z};
}

}  // namespace

core::Status WorldRecord::load(const core::Scene& scene) {
  auto starts = rigid_starts(scene);
  if (!starts) return starts.error();
  bodies_ = std::move(starts).value();
  scene_ = &scene;
  step_ = 0;
  states_.clear();
  for (const RigidStart& b : bodies_) states_.push_back(b.state);
  detected_ = states_;
  points_.clear();
  boxes_.clear();
  return core::Done{};
}

void WorldRecord::begin_step() {
  ++step_;
  detected_ = states_;
  points_.clear();
}

void WorldRecord::add_point(std::uint32_t a, std::uint32_t b, Vec point, Vec normal, double gap_m, Vec impulse) {
  const double turn = a < b ? 1.0 : -1.0;
  points_.push_back({std::min(a, b), std::max(a, b), narrow(point), narrow(turn * normal), static_cast<float>(gap_m),
                     narrow(turn * impulse), 0});
}

core::WideVec3 WorldRecord::origin(const RigidState& state, std::size_t body) const {
  return wide(state.x - plain::matrix(state.q) * bodies_[body].center_of_mass);
}

void WorldRecord::read_detection(core::FrameRecord& frame) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    frame.detected_position.push_back(core::narrowed(origin(detected_[i], i)));
    frame.detected_velocity.push_back(narrow(detected_[i].v));
    frame.detected_orientation.push_back(turns() ? core::narrowed(wide(detected_[i].q))
                                                 : scene_->bodies[i].orientation);
  }
  frame.boxes = boxes_;
}

core::Status WorldRecord::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  frame = {};
  frame.step = step_;
  frame.time_s = static_cast<double>(step_) * scene_->dt_s;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const RigidState& s = states_[i];
    const core::Quat still = scene_->bodies[i].orientation;
    const core::WideQuat q = turns() ? wide(s.q) : core::WideQuat{still.w, still.x, still.y, still.z};
    const core::WideVec3 w = turns() ? wide(s.w) : core::WideVec3{};
    const core::WideVec3 x = origin(s, i);
    frame.digest += core::body_digest(i, core::narrowed(x), core::narrowed(q), narrow(s.v), core::narrowed(w));
    if (level != core::RecordLevel::kFull) continue;
    frame.wide.position.push_back(x);
    frame.wide.orientation.push_back(q);
    frame.wide.velocity.push_back(wide(s.v));
    frame.wide.angular_velocity.push_back(w);
    frame.position.push_back(core::narrowed(x));
    frame.orientation.push_back(core::narrowed(q));
    frame.velocity.push_back(narrow(s.v));
    frame.angular_velocity.push_back(core::narrowed(w));
  }
  if (level != core::RecordLevel::kFull) return core::Done{};
  if (!boxes_.empty()) read_detection(frame);
  frame.points = points_;
  std::stable_sort(frame.points.begin(), frame.points.end(), [](const auto& p, const auto& q) {
    return std::tuple(core::is_face(p.b), p.a, p.b) < std::tuple(core::is_face(q.b), q.a, q.b);
  });
  return core::Done{};
}

}  // namespace broadside::reference
