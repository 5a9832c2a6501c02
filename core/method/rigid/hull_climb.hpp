// The corner of a hull that is lowest along a direction, found by going down its edges from a corner near it. This
// visits a dozen of a hull's hundreds of corners.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"

namespace broadside::core {

// Directions are sorted into cells on the six sides of a cube, kGuideCells each way. HullView::guide begins with a
// corner for each cell: the lowest one along the cell's middle direction. Then comes, for each corner, where its ways
// begin in HullView::ways, and the end of the last corner's ways.
inline constexpr int kGuideCells = 8;
inline constexpr std::uint32_t kGuideStarts = 6 * kGuideCells * kGuideCells;

namespace climb_detail {

// Which of the cells between -most and most x is in. Products are compared, because a quotient may be NaN.
BROADSIDE_HD std::uint32_t cell_of(float x, float most) {
  std::uint32_t cell = 0;
  for (int k = 1 - kGuideCells / 2; k < kGuideCells / 2; ++k)
    cell += x > (2.0F / kGuideCells) * static_cast<float>(k) * most ? 1U : 0U;
  return cell;
}

// The middle of a cell, as a share of `most`.
BROADSIDE_HD float middle_of_cell(std::uint32_t cell) {
  return (2.0F / kGuideCells) * (static_cast<float>(cell) + 0.5F) - 1.0F;
}

}  // namespace climb_detail

// A direction in the middle of the cell.
BROADSIDE_HD Vec3 middle_of_guide_cell(std::uint32_t cell) {
  const std::uint32_t side = cell / (kGuideCells * kGuideCells);
  const auto axis = static_cast<int>(side / 2);
  Vec3 middle;
  middle[axis] = (side & 1U) != 0 ? -1.0F : 1.0F;
  middle[axis == 0 ? 1 : 0] = climb_detail::middle_of_cell(cell / kGuideCells % kGuideCells);
  middle[axis == 2 ? 1 : 2] = climb_detail::middle_of_cell(cell % kGuideCells);
  return middle;
}

// The corner from which the search begins.
BROADSIDE_HD std::uint32_t climb_start(const HullView& hull, Vec3 direction) {
  const Vec3 size{fabsf(direction.x), fabsf(direction.y), fabsf(direction.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const float along = axis == 0 ? direction.x : (axis == 1 ? direction.y : direction.z);
  const float most = fabsf(along);
  const std::uint32_t u = climb_detail::cell_of(axis == 0 ? direction.y : direction.x, most);
  const std::uint32_t w = climb_detail::cell_of(axis == 2 ? direction.y : direction.z, most);
  const std::uint32_t side = 2U * static_cast<std::uint32_t>(axis) + (along < 0.0F ? 1U : 0U);
  return hull.guide[(side * kGuideCells + u) * kGuideCells + w];
}

// Goes down from the corner `from`. direction: in body axes, of any length. Steps are compared by height differences
// along edges, whose rounding is small because edges are short. So where the search stops, no corner is lower by more
// than rounding.
BROADSIDE_HD_CALLED std::uint32_t climb_down(const HullView& hull, Vec3 direction, std::uint32_t from) {
  const std::uint32_t* const begins = hull.guide + kGuideStarts;
  std::uint32_t here = from;
  for (std::uint32_t step = 0; step < hull.vertex_count; ++step) {
    std::uint32_t lowest = here;
    float least = 0.0F;
    const std::uint32_t end = begins[here + 1];
    for (std::uint32_t k = begins[here]; k < end; ++k) {
      const HullWay way = hull.ways[k];
      const float rise = dot(direction, way.along);
      if (!(rise < least)) continue;
      least = rise;
      lowest = way.to;
    }
    if (lowest == here) break;
    here = lowest;
  }
  return here;
}

// The lowest corner. From the guide's corner it takes half as many steps as from a corner that was lowest along another
// direction of the same search.
BROADSIDE_HD_CALLED std::uint32_t lowest_along(const HullView& hull, Vec3 direction) {
  return climb_down(hull, direction, climb_start(hull, direction));
}

}  // namespace broadside::core
