// The box of everywhere that a rigid body is during a step in which it moves and turns.
#pragma once

#include <span>

#include "core/exact/rigid_motion.hpp"
#include "core/math/box.hpp"

namespace broadside::exact {

// Contains every vertex at every time of the step, for certain: rounding goes outwards. It is the tight box of the
// vertices' paths but for that, and so at most placing_error_m and one step of a float too large on each side.
core::Box swept_box(std::span<const core::Vec3> vertices, const RigidMotion& motion);

}  // namespace broadside::exact
