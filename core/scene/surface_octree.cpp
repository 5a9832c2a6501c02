#include "core/scene/surface_octree.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace broadside::core {
namespace {

Box common(const Box& a, const Box& b) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = a.min[k] > b.min[k] ? a.min[k] : b.min[k];
    box.max[k] = a.max[k] < b.max[k] ? a.max[k] : b.max[k];
  }
  return box;
}

// Octant k of a cell: bit 0 for x, 1 for y, 2 for z. Neighboring octants share the plane between them.
Box octant_of(const Box& cell, int k) {
  Box octant = cell;
  const Vec3 middle = center(cell);
  for (int axis = 0; axis < 3; ++axis) ((k >> axis) & 1 ? octant.min : octant.max)[axis] = middle[axis];
  return octant;
}

// Whether the plane of a triangle intersects the box, in double; rounding can only add boxes.
bool meets_plane(const Box& box, Vec3 p, Vec3 q, Vec3 r) {
  const double a[3] = {double(q.x) - p.x, double(q.y) - p.y, double(q.z) - p.z};
  const double b[3] = {double(r.x) - p.x, double(r.y) - p.y, double(r.z) - p.z};
  const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  double height = 0.0;
  double reach = 0.0;
  double size = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double middle = 0.5 * (double(box.min[k]) + box.max[k]) - p[k];
    height += n[k] * middle;
    reach += std::abs(n[k]) * 0.5 * (double(box.max[k]) - box.min[k]);
    size += std::abs(n[k]) * (std::abs(middle) + std::abs(a[k]) + std::abs(b[k]));
  }
  return std::abs(height) <= reach + 0x1p-48 * size;
}

}  // namespace

NodeBoxes surface_node_boxes(const Mesh& mesh, Vec3 center_of_mass) {
  std::vector<Vec3> vertices = mesh.vertices;
  for (Vec3& v : vertices) v = v - center_of_mass;
  NodeBoxes nodes{};
  nodes.root = empty_box();
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t corner : t) nodes.root = grown(nodes.root, vertices[corner]);

  std::array<Box, 64> cells;
  for (int k = 0; k < 64; ++k) cells[static_cast<std::size_t>(k)] = octant_of(octant_of(nodes.root, k / 8), k % 8);
  std::array<Box, 64> leaves;
  leaves.fill(empty_box());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 p = vertices[t[0]];
    const Vec3 q = vertices[t[1]];
    const Vec3 r = vertices[t[2]];
    const Box around = grown(grown({p, p}, q), r);
    for (std::size_t k = 0; k < 64; ++k) {
      if (!overlaps(around, cells[k]) || !meets_plane(cells[k], p, q, r)) continue;
      const Box part = common(around, cells[k]);
      leaves[k] = grown(grown(leaves[k], part.min), part.max);
    }
  }
  for (std::size_t parent = 0; parent < 8; ++parent) {
    Box box = empty_box();
    const std::uint8_t first = nodes.level2_count;
    for (std::size_t k = 8 * parent; k < 8 * parent + 8; ++k) {
      if (is_empty(leaves[k])) continue;
      box = grown(grown(box, leaves[k].min), leaves[k].max);
      nodes.level2[nodes.level2_count++] = leaves[k];
    }
    if (is_empty(box)) continue;
    nodes.leaf_begin[nodes.level1_count] = first;
    nodes.level1[nodes.level1_count++] = box;
  }
  nodes.leaf_begin[nodes.level1_count] = nodes.level2_count;
  return nodes;
}

NodeBoxes single_node_boxes(const Box& box) {
  NodeBoxes nodes{};
  nodes.root = nodes.level1[0] = nodes.level2[0] = box;
  nodes.leaf_begin[1] = 1;
  nodes.level1_count = nodes.level2_count = 1;
  return nodes;
}

}  // namespace broadside::core
