#include "validation/mechanics/mesh_passage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/exact/swept_box.hpp"

namespace broadside::validation {
namespace {

// Places, orientations and vertices about the center of mass are rounded to float32 for the arbiter: each by half a
// unit of 2^-23, for two bodies at two times.
constexpr double kToFloat = 16.0 * 0x1p-24;

core::Vec3 to_float(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

exact::RigidMotion motion_between(const BodyState& from, const BodyState& to) {
  exact::RigidMotion motion;
  motion.start.position = to_float(from.x);
  motion.start.orientation = {static_cast<float>(from.q.w), static_cast<float>(from.q.x), static_cast<float>(from.q.y),
                              static_cast<float>(from.q.z)};
  motion.displacement_m = to_point(to.x - from.x);
  const Quatd turn = to.q * conjugate(from.q);
  const double sign = turn.w < 0.0 ? -1.0 : 1.0;
  const Vec3d axis{sign * turn.x, sign * turn.y, sign * turn.z};
  const double size = length(axis);
  if (size > 0.0) motion.rotation_rad = to_point((angle_of(turn) / size) * axis);
  return motion;
}

}  // namespace

const MeshPassage::Shape& MeshPassage::shape(const Motion& motion, std::uint32_t body) {
  const BodyFacts& facts = motion.facts[body];
  const auto known = shapes_.find(facts.mesh);
  if (known != shapes_.end()) return known->second;
  core::Mesh mesh = *scene_.meshes[facts.mesh];
  for (core::Vec3& v : mesh.vertices) v = to_float(Vec3d{v.x, v.y, v.z} - facts.center_of_mass);
  return shapes_.emplace(facts.mesh, Shape{mesh.vertices, exact::MovingShape(mesh, false)}).first->second;
}

double MeshPassage::deepest_m(const Motion& motion, core::Pair pair, std::size_t part, double moved_m) {
  const BodyState& from_a = motion.pose_after(part, pair.i);
  const BodyState& from_b = motion.pose_after(part, pair.j);
  const BodyState& to_a = motion.pose_after(part + 1, pair.i);
  const BodyState& to_b = motion.pose_after(part + 1, pair.j);
  const Shape& shape_a = shape(motion, pair.i);
  const Shape& shape_b = shape(motion, pair.j);
  const double far = std::max({length(from_a.x), length(to_a.x), length(from_b.x), length(to_b.x)});
  const double rounded_m = kToFloat * (far + motion.facts[pair.i].reach_m + motion.facts[pair.j].reach_m);
  const exact::RigidMotion motion_a = motion_between(from_a, to_a);
  const exact::RigidMotion motion_b = motion_between(from_b, to_b);
  // A box holds its body at every time of the step: bodies whose boxes are apart never touch.
  if (!core::overlaps(exact::swept_box(shape_a.vertices, motion_a), exact::swept_box(shape_b.vertices, motion_b)))
    return rounded_m;
  ++asked_;
  const exact::RigidTouch there = first_touch(shape_a.surface, motion_a, shape_b.surface, motion_b);
  if (there.meeting == exact::Meeting::kApart) return rounded_m;
  const exact::RigidTouch back =
      first_touch(shape_a.surface, motion_between(to_a, from_a), shape_b.surface, motion_between(to_b, from_b));
  const double last = back.meeting == exact::Meeting::kApart ? there.lower : 1.0 - back.lower;
  return 0.5 * moved_m * std::max(0.0, last - there.lower) + rounded_m;
}

}  // namespace broadside::validation
