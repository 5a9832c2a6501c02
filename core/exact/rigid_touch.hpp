// When two rigid bodies that move and turn first touch: certified brackets, by conservative advancement.
#pragma once

#include <cstdint>
#include <memory>

#include "core/exact/rigid_motion.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::exact {

enum class Meeting : std::uint8_t {
  kApart,  // they do not touch in [0, 1]
  kTouch,  // the first touch lies in [lower, upper]
  kGraze,  // they come within tolerance_m at `lower`, and no overlap was seen; whether they touch is not decided
};

struct RigidTouch {
  Meeting meeting = Meeting::kApart;
  double lower = 1.0;  // proved: no touch before this time, in units of the step
  double upper = 1.0;  // they overlap at this time
  std::uint32_t measurements = 0;
};

// A body's shape in its own axes: its triangles, and a solid where it is a box, a sphere, a capsule or convex. Two
// solids are judged as solids. Otherwise the surfaces of both are judged: a body inside another one, not crossing its
// surface, is apart from it.
class MovingShape {
 public:
  struct Parts;

  // With as_solid, a mesh becomes the primitive that it represents (core/scene/primitive.hpp), or its hull when it is
  // convex.
  MovingShape(const core::Mesh& mesh, bool as_solid);

  [[nodiscard]] bool is_solid() const;
  [[nodiscard]] double reach_m() const;  // the farthest point from the origin
  [[nodiscard]] const Parts& parts() const { return *parts_; }

 private:
  std::shared_ptr<const Parts> parts_;
};

// The search for the first touch ends when the bodies are nearer than this: 1e-9 of the sizes of both bodies. At
// `lower` they are no farther apart than this along a separating direction.
double touch_tolerance_m(const MovingShape& a, const MovingShape& b);

RigidTouch first_touch(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b,
                       const RigidMotion& motion_b);

}  // namespace broadside::exact
