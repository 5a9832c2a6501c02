// Bodies that end a step without an impulse, although its sweeps gave them some and took them back. An impulse that is
// added to a velocity and subtracted again leaves rounding, which no point of the trace explains. Such a body gets the
// velocities of one that nothing touched, to the last bit. Before, a card at rest behind others that a bullet struck
// went on with 0.24 micrometers a second.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/method/rigid/solver_body.hpp"

namespace broadside::core {

// Whether a patch gave its bodies anything in the substeps that are over: a normal impulse only grows from substep to
// substep, and friction needs one.
BROADSIDE_HD bool has_pushed(const PatchConstraint& c) {
  bool has = false;
  each_point(c, [&](int k) {
    const PatchPoint& p = c.points[k];
    has = has || p.normal_total != 0.0F || p.tangent_total_1 != 0.0F || p.tangent_total_2 != 0.0F;
  });
  return has;
}

// The velocities that gravity and the scene's wrench alone give in so many substeps. A wrench in body axes turns with
// the body, whose orientation the sweeps have changed, too; so a body with such a wrench is left as it is.
BROADSIDE_HD void forget_pushes(SolverBody& body, const RigidState& before, Vec3 gravity_m_s2,
                                const RigidWrench* wrench, float substep_s, std::uint32_t substeps) {
  if (!is_moved(body)) return;
  if (wrench != nullptr && !(wrench->force_body_n == Vec3{} && wrench->torque_body_n_m == Vec3{})) return;
  body.v = before.v;
  body.angular_momentum = before.angular_momentum;
  for (std::uint32_t k = 0; k < substeps; ++k) accelerate(body, gravity_m_s2, wrench, substep_s);
}

}  // namespace broadside::core
