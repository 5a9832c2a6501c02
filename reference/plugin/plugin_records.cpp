#include "reference/plugin/plugin_records.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reference/plugin/plugin_scene.hpp"

namespace broadside::reference {
namespace {

core::WideVec3 wide(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

core::WideQuat wide_quat(const double (&q)[4]) {
  return {q[0], q[1], q[2], q[3]};
}

template <std::size_t N>
bool is_finite(const double (&v)[N]) {
  return std::all_of(std::begin(v), std::end(v), [](double x) { return std::isfinite(x); });
}

}  // namespace

void add_state(const broadside_state2& s, core::FrameRecord& frame) {
  frame.wide.position.push_back(wide(s.position));
  frame.wide.orientation.push_back(wide_quat(s.orientation));
  frame.wide.velocity.push_back(wide(s.velocity));
  frame.wide.angular_velocity.push_back(wide(s.angular_velocity));
  frame.position.push_back(core::narrowed(frame.wide.position.back()));
  frame.orientation.push_back(core::narrowed(frame.wide.orientation.back()));
  frame.velocity.push_back(core::narrowed(frame.wide.velocity.back()));
  frame.angular_velocity.push_back(core::narrowed(frame.wide.angular_velocity.back()));
}

void add_detection(const broadside_detection& d, core::FrameRecord& frame) {
  frame.detected_position.push_back(core::narrowed(wide(d.position)));
  frame.detected_orientation.push_back(core::narrowed(wide_quat(d.orientation)));
  frame.detected_velocity.push_back(core::narrowed(wide(d.velocity)));
  frame.boxes.push_back({vec3_from_c(d.box.min), vec3_from_c(d.box.max)});
}

core::ContactPoint point_from_c(const broadside_point& p) {
  core::ContactPoint point;
  point.a = p.a;
  point.b = p.b;
  point.point = core::narrowed(wide(p.point));
  point.normal = core::narrowed(wide(p.normal));
  point.gap_m = static_cast<float>(p.gap);
  point.impulse = core::narrowed(wide(p.impulse));
  point.feature = p.feature;
  return point;
}

core::Contact contact_from_c(const broadside_contact& c) {
  core::Contact contact;
  contact.a = c.a;
  contact.b = c.b;
  contact.color = core::is_face(c.b) ? core::kFaceColor : 0;
  contact.depth_m = c.depth_m;
  contact.normal = vec3_from_c(c.normal);
  contact.normal_impulse_n_s = c.normal_impulse;
  contact.tangent = vec3_from_c(c.tangent);
  contact.tangent_impulse_n_s = c.tangent_impulse;
  contact.pre_a = {vec3_from_c(c.pre_position_a), vec3_from_c(c.pre_velocity_a)};
  contact.pre_b = {vec3_from_c(c.pre_position_b), vec3_from_c(c.pre_velocity_b)};
  contact.post_a = {vec3_from_c(c.post_position_a), vec3_from_c(c.post_velocity_a)};
  contact.post_b = {vec3_from_c(c.post_position_b), vec3_from_c(c.post_velocity_b)};
  return contact;
}

std::string fault_of_bodies(std::uint32_t a, std::uint32_t b, std::uint32_t body_count) {
  const bool has_b = b < body_count || (core::is_face(b) && b < core::kFirstFace + core::kFaceCount);
  if (a < body_count && has_b && a != b) return {};
  return "is between " + std::to_string(a) + " and " + std::to_string(b) + ", and there are " +
         std::to_string(body_count) + " bodies";
}

std::string fault_of_point(const broadside_point& p, std::uint32_t body_count) {
  if (std::string wrong = fault_of_bodies(p.a, p.b, body_count); !wrong.empty()) return wrong;
  if (!is_finite(p.impulse)) return "has an impulse that is NaN or infinite";
  if (!is_finite(p.point) || !is_finite(p.normal) || !std::isfinite(p.gap))
    return "has a place, a normal or a gap that is NaN or infinite";
  return {};
}

}  // namespace broadside::reference
