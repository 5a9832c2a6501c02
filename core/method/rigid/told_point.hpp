// Which points of a patch a step records, and how.
#pragma once

#include "core/attributes.hpp"
#include "core/contact_point.hpp"
#include "core/method/rigid/manifold.hpp"

namespace broadside::core {

// Records a point that touched or has an impulse; false for one that had a gap and no impulse. impulse: N s on A, of
// the whole step. center_a: A's center of mass at detection.
BROADSIDE_HD constexpr bool told_point(const ContactPatch& patch, int k, Vec3 impulse, Vec3 center_a,
                                       ContactPoint& told) {
  const ManifoldPoint& p = patch.manifold.points[k];
  if (p.gap_m > 0.0F && impulse == Vec3{}) return false;
  told = {patch.a, patch.b, center_a + p.point, patch.manifold.normal, p.gap_m, impulse, p.feature};
  return true;
}

}  // namespace broadside::core
