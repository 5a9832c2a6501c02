// One step of every body, in float64: what the laws of mechanics read. Built once a frame for all of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/exact/convex_core.hpp"
#include "core/scene/primitive.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"
#include "validation/mechanics/mat3d.hpp"
#include "validation/overlap_join.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {

// The properties of a body that never change.
struct BodyFacts {
  bool is_dynamic = false;
  bool has_spring = false;
  bool has_inertia = false;
  double mass_kg = 0.0;
  Vec3d center_of_mass;          // in mesh coordinates, m
  Mat3d inertia;                 // kg m^2, about the center of mass, in mesh axes
  Mat3d inverse_inertia;         // 1/(kg m^2)
  double least_moment = 0.0;     // kg m^2
  double largest_moment = 0.0;   // kg m^2
  double reach_m = 0.0;          // farthest point of the mesh from the center of mass
  double smallest_side_m = 0.0;  // of the mesh's box
  Vec3d box_center;              // of the mesh's box, in mesh coordinates
  Vec3d box_half;                // m
  double ball_radius_m = 0.0;    // of a sphere; 0 for any other shape
  std::uint32_t mesh = 0;
  // The scene's wrenches on it, summed: those that are constant in the world and those in the body's axes.
  Vec3d force_world_n;
  Vec3d force_body_n;
  Vec3d torque_world_n_m;
  Vec3d torque_body_n_m;
};

// A state, of the center of mass, in the world.
struct BodyState {
  Vec3d origin;  // of the mesh, m
  Vec3d x;       // center of mass, m
  Quatd q;       // unit
  Mat3d r;
  Vec3d v;                 // m/s
  Vec3d w;                 // rad/s
  Vec3d angular_momentum;  // kg m^2/s; zero without inertia
};

struct BodyStep {
  BodyState before;
  BodyState after;
  // Whether the body cannot have touched anything: on the path that its start predicts, its box, grown by the margin,
  // stays inside the domain and meets no other body, neither on that body's predicted path nor, if something may have
  // deflected that body, on its recorded one. The recorded path of this body itself is not used, so a wrong motion
  // cannot excuse itself.
  bool is_alone = false;
  // Of gravity and the scene's wrenches at the start of the step. What is constant in the body's axes turns with it:
  // over the step the mean differs by at most the slack.
  Vec3d acceleration;               // m/s^2
  double acceleration_slack = 0.0;  // m/s^2
  Vec3d torque;                     // N m
  double torque_slack = 0.0;        // N m
  bool is_torque_free = true;
  // Bodies that may have touched each other, directly or through others, have one number; static bodies have none.
  std::uint32_t set = 0;
};

// Whether any bit of its place or velocity changed.
constexpr bool has_moved(const BodyStep& b) {
  const auto same = [](Vec3d a, Vec3d c) { return a.x == c.x && a.y == c.y && a.z == c.z; };
  return !same(b.before.origin, b.after.origin) || !same(b.before.v, b.after.v);
}

struct Motion {
  std::uint64_t step = 0;
  double h = 0.0;               // s
  Vec3d gravity;                // m/s^2
  double u = 0.0;               // unit roundoff of the states
  double substeps = 1.0;        // declared: how often a step updates and rounds the states
  bool turns = false;           // the scene's bodies may turn
  double strongest_pull = 0.0;  // m/s^2; the largest acceleration of gravity and wrenches
  std::span<const BodyFacts> facts;
  std::vector<BodyStep> bodies;
  std::vector<BodyState> between;  // poses, without velocities: all bodies between the parts of the step, in turn
  std::vector<core::Pair> near;    // pairs of bodies whose swept boxes meet
  std::vector<std::uint8_t> set_is_free;  // by set: none of its bodies may have touched a static body or the domain

  // Equal parts whose ends are known.
  [[nodiscard]] std::size_t parts() const { return bodies.empty() ? 1 : between.size() / bodies.size() + 1; }
  // Where a body was at the end of so many of them.
  [[nodiscard]] const BodyState& pose_after(std::size_t parts_gone, std::size_t body) const {
    if (parts_gone == 0) return bodies[body].before;
    return parts_gone == parts() ? bodies[body].after : between[(parts_gone - 1) * bodies.size() + body];
  }
  // n rounded operations, relative.
  [[nodiscard]] double rounding_of(double operations) const { return operations * u; }
};

// Follows a trace. Memory: one state a body.
class MotionReader {
 public:
  explicit MotionReader(const core::TraceHeader& header);

  // Null where the step cannot be judged: frames between were not recorded, or a state is not finite.
  const Motion* read(const core::FrameRecord& frame, const core::FrameRecord* previous);
  [[nodiscard]] std::span<const BodyFacts> facts() const { return facts_; }

 private:
  [[nodiscard]] std::optional<BodyState> state_of(const core::FrameRecord& frame, std::size_t body) const;
  [[nodiscard]] BodyState start_of(std::size_t body) const;
  // Poses between parts; none where one is not finite, or where they are not those of all bodies.
  void read_between(const core::FrameRecord& frame);
  void complete(BodyState& state, std::size_t body) const;
  void find_neighbors();
  void find_pulls();
  // The box of the body's predicted path within the step, grown by the margin.
  [[nodiscard]] core::Box predicted_box(std::size_t body) const;
  // The same, joined with the boxes of its recorded poses.
  [[nodiscard]] core::Box swept_box(std::size_t body) const;
  // By body: whether it can have touched something.
  void find_touchable();

  const core::TraceHeader& header_;
  std::vector<BodyFacts> facts_;
  double margin_m_;  // what engines may see bodies touch at, beyond their shapes
  std::vector<std::uint8_t> is_static_;
  Motion motion_;
  OverlapJoin join_;
  std::vector<core::Box> predicted_;
  std::vector<core::Box> swept_;
  std::vector<std::uint8_t> is_touchable_;
};

// The mass properties, shapes and sizes of the scene's bodies.
std::vector<BodyFacts> facts_of(const core::Scene& scene);

// What recorded states are rounded to: float32 or float64, and the engine's arithmetic where that is coarser.
double state_roundoff(const core::TraceHeader& header);

// Signed distances of bodies with convex shapes: boxes, spheres, capsules and convex meshes.
class ExactShapes {
 public:
  explicit ExactShapes(const core::Scene& scene);
  [[nodiscard]] bool knows(std::uint32_t mesh) const { return cores_[mesh].has_value(); }
  [[nodiscard]] exact::ConvexCore placed(std::uint32_t mesh, Vec3d origin, Quatd q) const;

 private:
  std::vector<std::optional<exact::ConvexCore>> cores_;
};

constexpr exact::Point to_point(Vec3d v) {
  return {v.x, v.y, v.z};
}
constexpr Vec3d to_vec3d(exact::Point p) {
  return {p.x, p.y, p.z};
}

std::string vector_text(Vec3d v);

}  // namespace broadside::validation
