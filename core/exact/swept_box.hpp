// The box that contains a rigid body during a whole step in which it moves and turns.
#pragma once

#include <span>

#include "core/exact/rigid_motion.hpp"
#include "core/math/box.hpp"

namespace broadside::exact {

// Contains every vertex at every time of the step: rounding goes outwards. Apart from rounding it is the tight box of
// the vertices' paths, so it is at most placing_error_m and one float step too large on each side.
core::Box swept_box(std::span<const core::Vec3> vertices, const RigidMotion& motion);

}  // namespace broadside::exact
