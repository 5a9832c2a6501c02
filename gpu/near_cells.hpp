// For each cell of a grid around a shape, the vertices that can be the nearest to a point in it: what the proximity
// stage looks up instead of descending the shape's tree.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/vec3.hpp"
#include "gpu/shape_tree.hpp"

namespace broadside::gpu {

// Cells of one shape, in body coordinates: x fastest, then y, then z. No cells: count_x is 0.
struct NearCells {
  core::Vec3 low;
  float cells_per_m = 0.0F;
  std::uint32_t count_x = 0;
  std::uint32_t count_y = 0;
  std::uint32_t count_z = 0;
  float lower_step_m = 0.0F;      // of `lower`
  float range_m = 0.0F;           // lists are right where no world coordinate of the vertices is larger
  std::uint32_t first_lower = 0;  // where the shape's words begin in the arrays shared by all shapes
  std::uint32_t first_begin = 0;
  std::uint32_t first_entry = 0;
};

constexpr std::uint8_t kNothingNear = 0xFF;

struct ShapeCells {
  std::vector<NearCells> headers;  // one per shape
  // Per cell: no vertex is nearer to a point in it than so many lower_step_m; kNothingNear: none is nearer than theta.
  std::vector<std::uint8_t> lower;
  // Per cell and one more: where its list begins, counted from the shape's first entry.
  std::vector<std::uint32_t> begin;
  // Vertices by their place in the tree's order, two a word, the first in the lower half: a list of an odd number ends
  // with one of them twice.
  std::vector<std::uint32_t> entries;
};

// How exact the lists must be for the scene at hand.
struct NearNeeds {
  float theta_m = 0.0F;   // the largest under which vertices of the shape touch any other's
  float extent_m = 0.0F;  // the largest coordinate of any shape's vertices in body coordinates
  float range_m = 0.0F;   // the largest world coordinate that is to be expected
};

// Appends the header of the last shape of `trees`, and its cells if they pay: for a mesh of some hundred to some
// thousand vertices whose theta is about its edges' length.
// Lists are complete in the arithmetic of core::squared_distance: a vertex that is left out of a cell's list is farther
// than theta or than another of the list, by more than all roundings together, from every point of the cell.
void append_cells(ShapeCells& cells, const ShapeTrees& trees, const NearNeeds& needs);
// Only the header, for a shape that has none.
void append_no_cells(ShapeCells& cells);

}  // namespace broadside::gpu
