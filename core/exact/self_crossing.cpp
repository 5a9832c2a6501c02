#include "core/exact/self_crossing.hpp"

#include <algorithm>

#include "core/exact/predicates.hpp"
#include "core/exact/triangle_tree.hpp"

namespace broadside::exact {
namespace {

using Node = TriangleTree::Node;

bool meet(const core::Box& a, const core::Box& b) {
  for (int k = 0; k < 3; ++k)
    if (a.min[k] > b.max[k] || b.min[k] > a.max[k]) return false;
  return true;
}

bool share_a_vertex(const core::Triangle& p, const core::Triangle& q) {
  for (const std::uint32_t v : p)
    if (std::find(q.begin(), q.end(), v) != q.end()) return true;
  return false;
}

// p and q are leaves; they may be the same leaf.
bool cross_in(const TriangleTree& tree, const Node& p, const Node& q) {
  for (std::uint32_t i = p.first; i < p.first + p.count; ++i)
    for (std::uint32_t j = std::max(q.first, p.first == q.first ? i + 1 : q.first); j < q.first + q.count; ++j)
      if (!share_a_vertex(tree.triangles()[i], tree.triangles()[j]) &&
          triangles_meet(corners_of(tree, i, {}), corners_of(tree, j, {})))
        return true;
  return false;
}

// Visits every pair of leaves once: p = q splits into (left, left), (left, right), (right, right).
bool cross_below(const TriangleTree& tree, std::uint32_t a, std::uint32_t b) {
  const Node& p = tree.nodes()[a];
  const Node& q = tree.nodes()[b];
  if (a != b && !meet(p.box, q.box)) return false;
  if (p.count > 0 && q.count > 0) return cross_in(tree, p, q);
  if (a == b)
    return cross_below(tree, p.first, p.first) || cross_below(tree, p.first, p.first + 1) ||
           cross_below(tree, p.first + 1, p.first + 1);
  if (q.count > 0) return cross_below(tree, p.first, b) || cross_below(tree, p.first + 1, b);
  return cross_below(tree, a, q.first) || cross_below(tree, a, q.first + 1);
}

}  // namespace

bool crosses_itself(const core::Mesh& mesh) {
  return !mesh.triangles.empty() && cross_below(TriangleTree(mesh, {}), 0, 0);
}

}  // namespace broadside::exact
