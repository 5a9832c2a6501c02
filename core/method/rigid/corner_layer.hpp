// The corners of a polytope that are lowest along a direction, and the layer above them.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/lanes.hpp"

namespace broadside::core {

template <typename Polytope>
BROADSIDE_HD int lowest_corner(const Polytope& p, Vec3 direction) {
  const Vec3 local = p.local(direction);
  return Polytope::Lanes::first_least(p.corner_count(), [&](int k) { return p.height(k, local); }).item;
}

// The part of a body that may be within some distance of the other body: its corners and edges up to a height above its
// lowest corner along a direction that points away from the other body.
struct Layer {
  Vec3 direction;  // as local() gives it
  float top = 3.402823e38F;
};

template <typename Polytope>
BROADSIDE_HD bool reaches_into(const Polytope& p, const Layer& layer, int from, int to) {
  return p.height(from, layer.direction) <= layer.top || p.height(to, layer.direction) <= layer.top;
}

// thickness_m: above the lowest corner along the unit direction.
template <typename Polytope>
BROADSIDE_HD Layer layer_of(const Polytope& p, Vec3 direction, float thickness_m) {
  const Vec3 local = p.local(direction);
  return {local, p.height(lowest_corner(p, direction), local) + thickness_m};
}

// Where on the segment from p to q the point nearest to x is: 0 at p, 1 at q.
BROADSIDE_HD float share_nearest(Vec3 x, Vec3 p, Vec3 q) {
  const Vec3 along = q - p;
  const float squared = dot(along, along);
  const float share = squared > 0.0F ? dot(x - p, along) / squared : 0.0F;
  return share <= 0.0F ? 0.0F : (share >= 1.0F ? 1.0F : share);
}

}  // namespace broadside::core
