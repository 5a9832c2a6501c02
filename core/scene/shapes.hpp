// What the pipeline precomputes once per distinct (mesh, orientation). Bodies only translate, so a rotated mesh is one
// more shape, and no frame rotates a vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/body_octree.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

struct Shape {
  std::uint32_t mesh = 0;
  float mean_edge_m = 0.0F;  // of the mesh
  BodyOctree octree;         // boxes[0] is the body's box relative to its position
};

struct ShapeTable {
  std::vector<Shape> shapes;
  std::vector<std::uint32_t> shape_of_body;
};

ShapeTable build_shapes(const Scene& scene);

// The distance below which vertices of these two shapes touch: the scene's, or the mean of both mean edge lengths.
float pair_theta_m(const Parameters& parameters, const Shape& a, const Shape& b);

}  // namespace broadside::core
