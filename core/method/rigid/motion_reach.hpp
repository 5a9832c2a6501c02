// How far a body can move within a step: contacts are looked for that far ahead, RIGID 8.7.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {

// Two balls about the center of mass, m: the shape is inside the outer one and contains the inner one.
struct ShapeBalls {
  float outer_m = 0.0F;
  float inner_m = 0.0F;
};

// The motion of a body within a step while it touches nothing, under gravity and its wrench.
struct FreeMotion {
  Vec3 drift;            // of the center by its velocity alone, m
  Vec3 fall;             // the most that the velocity gained in the step adds to it, m
  float swing_m = 0.0F;  // added by turning: the farthest that a point gets outside the moved shape

  // How far ahead contacts are looked for, in whatever direction the body is pushed.
  BROADSIDE_HD float reach_m() const { return (length(drift) + length(fall)) + swing_m; }
};

// However far it turns, the shape stays between its two balls; so the swing of a sphere is 0, however fast it spins. An
// impulse of this step counts only from the next step on.
BROADSIDE_HD FreeMotion free_motion(const RigidState& s, const RigidMass& mass, ShapeBalls balls, Vec3 gravity_m_s2,
                                    const RigidWrench& wrench, float dt_s) {
  FreeMotion m;
  if (!(mass.inverse_mass > 0.0F)) return m;
  const Vec3 force = wrench.force_world_n + rotate(s.q, wrench.force_body_n);
  m.drift = dt_s * s.v;
  m.fall = (dt_s * dt_s) * (gravity_m_s2 + mass.inverse_mass * force);
  m.swing_m = fminf(dt_s * length(angular_velocity(mass, s)) * balls.outer_m, balls.outer_m - balls.inner_m);
  return m;
}

// For how many steps, this one included, candidate pairs are looked for, so that a body that is going to be struck is
// known in time (pushed_motion.hpp). half_thickness_m: of the body. A body that moves farther than that in a step
// drives several others within the step, and each earlier step passes its push on only to those bodies that the last
// ones to get it would be driven to. Before, of six cubes in a row, 3 cm apart, of which the first was struck at 20
// m/s, two ended 13 cm deep in each other.
BROADSIDE_HD int steps_ahead(const FreeMotion& m, float half_thickness_m) {
  return length(m.drift) > half_thickness_m ? 4 : 2;
}

// The box of the space that a shape with this box may fill within this many steps: where it is, and where it drifts and
// falls to. To every side it also covers the distance that gravity moves the body in a step. Patches so near are always
// kept (near_m), because a blow passes within a step through bodies that touch. Before, a brick 0.2 mm beside a row
// that was struck at 20 m/s was in no candidate pair, and a body entered it by 64 mm. The box is grown by more than the
// rounding of this step's sums; for the steps after it, rounding is not covered to the last bit.
BROADSIDE_HD Box swept_box(const Box& box, const FreeMotion& m, int steps) {
  const float near_m = length(m.fall);
  Box swept;
  for (int k = 0; k < 3; ++k) {
    const float drift = m.drift[k];
    float low = fminf(drift, -near_m);
    float high = fmaxf(drift, near_m);
    float moves = drift;  // in a step
    float moved = 0.0F;   // since the start
    for (int step = 0; step < steps; ++step) {
      moves = moves + m.fall[k];
      moved = moved + moves;
      low = fminf(low, moved);
      high = fmaxf(high, moved);
    }
    const float pad = m.swing_m + 0x1p-22F * (fmaxf(fabsf(box.min[k]), fabsf(box.max[k])) + (high - low));
    swept.min[k] = (box.min[k] + low) - pad;
    swept.max[k] = (box.max[k] + high) + pad;
  }
  return swept;
}

// Whether a body with this box that may move by reach_m reaches the face (0 to 5: -x +x -y +y -z +z) of the domain.
BROADSIDE_HD bool may_reach_face(const Box& box, float reach_m, const Box& domain, std::uint32_t face) {
  const int axis = static_cast<int>(face / 2);
  const bool is_inside =
      (face & 1U) != 0 ? box.max[axis] + reach_m < domain.max[axis] : box.min[axis] - reach_m > domain.min[axis];
  return !is_inside;
}

}  // namespace broadside::core
