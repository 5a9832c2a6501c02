// Two moving bodies at one time of their step: are they separated, until when at least, and do they overlap?
#pragma once

#include <limits>
#include <optional>

#include "core/exact/rigid_touch.hpp"
#include "core/exact/sphere_tree.hpp"

namespace broadside::exact {

struct MovingShape::Parts {
  std::optional<ConvexCore> solid;
  SphereTree surface;
  double reach_m = 0.0;
};

// until: no touch from the measured time to that one; 2 for the rest of the step. gap_m: the gap along the direction
// that proves it, between the parts whose separation is proved for the shortest time.
struct Parting {
  double until = 2.0;
  double gap_m = std::numeric_limits<double>::infinity();
};

class MovingPair {
 public:
  virtual ~MovingPair() = default;
  virtual Parting parting_at(double time) = 0;
  // True only when the overlap is certain: deeper than rounding.
  virtual bool overlap_at(double time) = 0;
};

std::unique_ptr<MovingPair> solid_pair(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b,
                                       const RigidMotion& motion_b);
std::unique_ptr<MovingPair> surface_pair(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b,
                                         const RigidMotion& motion_b);

}  // namespace broadside::exact
