// A box tree over the triangles of one rotated mesh, and the least distance of two translated trees.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/exact/triangle_distance.hpp"
#include "core/math/box.hpp"
#include "core/math/quat.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::exact {

// Vertices are the same as the pipeline's: rotated in float here, translated in float where they are used, and double
// from there on. So the reference answer is for exactly the points that the pipeline compares.
class TriangleTree {
 public:
  struct Node {
    core::Box box;            // of the rotated vertices, before translation
    std::uint32_t first = 0;  // leaf: its first triangle; otherwise its first child, and the second follows it
    std::uint32_t count = 0;  // triangles of a leaf; 0 = not a leaf
  };

  TriangleTree(const core::Mesh& mesh, core::Quat orientation);

  [[nodiscard]] const std::vector<core::Vec3>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<core::Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

 private:
  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<core::Vec3> vertices_;
  std::vector<core::Triangle> triangles_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

// Corners of triangle k of a tree moved to x.
Corners corners_of(const TriangleTree& tree, std::uint32_t k, core::Vec3 x);

// Least distance of the surfaces of two trees translated to xa and xb: 0 where they cross. A body inside another one
// that does not touch its surface is apart from it.
Nearest nearest_of_trees(const TriangleTree& a, core::Vec3 xa, const TriangleTree& b, core::Vec3 xb);

// The same distance, by visiting every pair of triangles.
Nearest nearest_by_brute_force(const TriangleTree& a, core::Vec3 xa, const TriangleTree& b, core::Vec3 xb);

// Least distance of any vertex of one to any vertex of the other, d_vv of METHOD section 3, by visiting every pair.
Nearest nearest_vertices(const TriangleTree& a, core::Vec3 xa, const TriangleTree& b, core::Vec3 xb);

}  // namespace broadside::exact
