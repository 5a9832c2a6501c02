// The corner of a hull that is lowest along a direction, found by going down its edges. On the way it looks at one or
// two dozen of a hull's hundreds of corners.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"

namespace broadside::core {

// HullView::ways begins with the corners farthest along -x, +x, -y, +y, -z and +z; then, for each corner and behind the
// last one, where in the table its neighbors begin; then the neighbors.
inline constexpr std::uint32_t kHullEnds = 6;

// The corner from which the search begins: the farthest one along the axis on which the direction is largest.
BROADSIDE_HD std::uint32_t climb_start(const HullView& hull, Vec3 direction) {
  const Vec3 size{fabsf(direction.x), fabsf(direction.y), fabsf(direction.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  return hull.ways[2 * axis + (direction[axis] < 0.0F ? 1 : 0)];
}

// From `from` on. direction: body axes, of any length. Steps are compared by differences along edges, which are as
// exact as an edge is short; so where it stops, no corner is lower but for rounding.
BROADSIDE_HD std::uint32_t climb_down(const HullView& hull, Vec3 direction, std::uint32_t from) {
  std::uint32_t here = from;
  for (std::uint32_t step = 0; step < hull.vertex_count; ++step) {
    const Vec3 at = hull.vertices[here];
    std::uint32_t lowest = here;
    float least = 0.0F;
    for (std::uint32_t k = hull.ways[kHullEnds + here]; k < hull.ways[kHullEnds + here + 1]; ++k) {
      const std::uint32_t next = hull.ways[k];
      const float rise = dot(direction, hull.vertices[next] - at);
      if (!(rise < least)) continue;
      least = rise;
      lowest = next;
    }
    if (lowest == here) break;
    here = lowest;
  }
  return here;
}

}  // namespace broadside::core
