// For each cell of a grid around a shape, the vertices that can be the nearest to a point in that cell. The proximity
// stage looks them up instead of descending the shape's tree.
#pragma once

#include <cstdint>
#include <vector>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "gpu/scene/shape_tree.hpp"

namespace broadside::gpu {

// Cells lie in memory in bricks of 8 x 4 x 4, x fastest; bricks follow each other in x, then y, then z. So neighboring
// vertices look into few lines of 128 bytes, and the number of lines is what look-ups cost. The strides are those of
// NearCells.
BROADSIDE_HD constexpr std::uint32_t cell_index(std::uint32_t x, std::uint32_t y, std::uint32_t z,
                                                std::uint32_t stride_y, std::uint32_t stride_z) {
  return (x + (x >> 3U) * 120) + (y * 8 + (y >> 2U) * stride_y) + (z * 32 + (z >> 2U) * stride_z);
}

// A list of near vertices: where it begins among the shape's entries, and how many entries it has.
struct NearList {
  static constexpr std::uint32_t kLengthBits = 10;
  std::uint32_t begin = 0;
  std::uint32_t length = 0;
};
BROADSIDE_HD constexpr NearList unpacked_list(std::uint32_t word) {
  return {word >> NearList::kLengthBits, word & ((1U << NearList::kLengthBits) - 1U)};
}

// Four vertices of a list, by their place in the tree's order. In the last entry of a list the last vertices may
// repeat.
struct alignas(8) NearEntry {
  std::uint16_t vertex[4] = {};
};
static_assert(sizeof(NearEntry) == 8, "read in one word of 8 bytes");

// A vertex's offset from its body's origin in quanta, rounded down.
struct alignas(8) QuantizedVertex {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 0;
  std::int16_t none = 0;
};
static_assert(sizeof(QuantizedVertex) == 8, "two are read in one word of 16 bytes");

// Cells of one shape, in body coordinates. Places are looked up in whole quanta, which are the same for all shapes of a
// scene; a cell is 2^shift quanta wide. If a shape has no cells, count_x is 0, and range_m is such that no coordinate
// is within it.
struct NearCells {
  core::Vec3 low;
  float quanta_per_m = 0.0F;
  std::uint32_t shift = 0;
  std::int32_t reach = 0;  // in quanta: farther than any vertex of any shape is from its body's origin
  std::uint32_t count_x = 0;
  std::uint32_t count_y = 0;
  std::uint32_t count_z = 0;
  std::uint32_t stride_y = 0;  // of cell_index
  std::uint32_t stride_z = 0;
  float lower_step_m = 0.0F;      // of `lower`
  float range_m = -1.0F;          // lists are right if no world coordinate of the vertices is larger
  std::uint32_t first_lower = 0;  // where the shape's words begin in the arrays shared by all shapes
  std::uint32_t first_list = 0;
  std::uint32_t first_entry = 0;
};

constexpr std::uint8_t kNothingNear = 0xFF;

struct ShapeCells {
  std::vector<NearCells> headers;  // one per shape
  // Per cell: no vertex is nearer to a point in the cell than this many lower_step_m; kNothingNear: none is nearer than
  // theta.
  std::vector<std::uint8_t> lower;
  std::vector<std::uint32_t> lists;  // per cell: unpacked_list
  std::vector<NearEntry> entries;
  // Of all shapes, in the trees' order, if any shape has cells. A vertex that fills up a last leaf repeats the one
  // before it.
  std::vector<QuantizedVertex> quantized;
};

// How exact the lists must be for the scene at hand.
struct NearNeeds {
  float theta_m = 0.0F;        // the largest under which vertices of the shape touch any other's
  float least_theta_m = 0.0F;  // the smallest theta_m of all shapes
  float extent_m = 0.0F;       // the largest coordinate of any shape's vertices in body coordinates
  float range_m = 0.0F;        // the largest world coordinate that is to be expected
};

// Appends the header of the last shape of `trees`, and its cells if they pay, which they do for meshes of some hundred
// to some thousand vertices whose theta is about the length of their edges. Lists are complete in the arithmetic of
// core::squared_distance: a vertex that is not in a cell's list is, from every point of the cell, farther than theta or
// farther than a vertex of the list, by more than all roundings together.
void append_cells(ShapeCells& cells, const ShapeTrees& trees, const NearNeeds& needs);
// Appends only a header, for a shape that gets no cells.
void append_no_cells(ShapeCells& cells);
// Call it when all shapes have their headers.
void quantize_vertices(ShapeCells& cells, const ShapeTrees& trees);

}  // namespace broadside::gpu
