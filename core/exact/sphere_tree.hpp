// A tree of balls over a mesh's triangles, in double; the balls turn with the body.
#pragma once

#include <cstdint>
#include <vector>

#include "core/exact/triangle_distance.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::exact {

struct SphereTree {
  struct Node {
    Point center;  // body axes
    double radius_m = 0.0;
    std::uint32_t first = 0;  // leaf: its triangle; otherwise its first child, and the second follows it
    bool is_leaf = false;
  };

  std::vector<Corners> triangles;
  std::vector<Node> nodes;  // the root first; none for a mesh without triangles
};

SphereTree make_sphere_tree(const core::Mesh& mesh);

}  // namespace broadside::exact
