// Where bodies start: positions and velocities for the two scenes of METHOD section 9. Made by pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/scene.hpp"

namespace broadside::datasets {

struct Start {
  std::vector<core::Vec3> positions;   // of the mesh's origin, m
  std::vector<core::Vec3> velocities;  // m/s
  core::Box domain;
};

// Adds one body of mesh 0 at each position, and sets the domain.
void place(core::Scene& scene, const Start& start);

struct StackedGrid {
  double gap = 0.1;            // between cells, as a share of the body box's longest side
  double drop_m = 1.0;         // from the floor to the lowest boxes, before jitter
  double jitter = 0.45;        // largest shift per axis as a share of the gap; below 0.5, so no two boxes touch
  double width_of_grid = 2.0;  // the domain's width, as a multiple of the grid's
};

// Free fall: the floor is y = 0 and the domain is centered on the y axis. Cells of pitch (1 + gap) x the longest side
// of `body` (the mesh's box), g = the smallest whole number with g^3 >= count per side in x and z, filled layer by
// layer upward, x fastest. The domain is a cube of width_of_grid x g x pitch, taller where the start needs it. At rest.
Start stacked_grid(const core::Box& body, std::uint32_t count, const StackedGrid& grid, std::uint64_t seed);

struct FilledCube {
  double fill = 0.2;           // share of the cube's volume inside body boxes
  double top_speed_m_s = 5.0;  // speeds are uniform from 0 to this, in random directions
};

// Random move: a cube centered on the origin. Bodies start in distinct, randomly chosen cells of a grid whose cells are
// larger than the box, shifted at random within their cells; so no two boxes overlap. Where the cube has no room for
// such a grid (for one long thin body, say), it grows by 1 % at a time until it has, and the fill is lower.
Start filled_cube(const core::Box& body, std::uint32_t count, const FilledCube& cube, std::uint64_t seed);

}  // namespace broadside::datasets
