// Impacts are not carried to the next substep. A substep begins with the impulses that the one before ended with. For a
// body at rest these impulses are right. But they push a body that an impact has just stopped away again, and sweeps
// have to take that back. Where masses are far apart they cannot: 61 N s that stopped 8 kg through a cube of 16 g on
// the floor are taken back by 0.1 N s a sweep. So patches of bodies that a bounce reached begin the next substep
// without an impulse.
//
// Before, only the impulses of patches that bounced were dropped, and the floor's impulse on the cube was kept: the 8
// kg that had come to rest left at 2 m/s.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_settings.hpp"

namespace broadside::core {

BROADSIDE_HD constexpr bool forgets_blows(SolveKind kind) {
  return kind == SolveKind::kUneven;
}

// Adds what the patch gave in the substep to its totals, and keeps none of it for the next substep.
BROADSIDE_HD void drop_impulses(PatchConstraint& c) {
  each_point(c, [&](int k) {
    PatchPoint& p = c.points[k];
    p.normal_total = p.normal_total + p.normal_impulse;
    p.tangent_total_1 = p.tangent_total_1 + p.tangent_impulse_1;
    p.tangent_total_2 = p.tangent_total_2 + p.tangent_impulse_2;
    p.normal_impulse = p.tangent_impulse_1 = p.tangent_impulse_2 = 0.0F;
  });
}

}  // namespace broadside::core
