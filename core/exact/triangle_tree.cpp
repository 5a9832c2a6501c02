#include "core/exact/triangle_tree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace broadside::exact {
namespace {

using core::Box;
using core::Triangle;
using core::Vec3;

// Leaves of four triangles keep the tree at half the triangles' memory, and testing 16 pairs of triangles costs about
// as much as testing the boxes that would separate them.
constexpr std::uint32_t kLeafTriangles = 4;

constexpr Nearest kBeyond{std::numeric_limits<double>::infinity(), {}, {}};

Box box_of(const std::vector<Vec3>& vertices, const Triangle& t) {
  return core::grown(core::grown(core::grown(core::empty_box(), vertices[t[0]]), vertices[t[1]]), vertices[t[2]]);
}

Box joined(const Box& a, const Box& b) {
  return core::grown(core::grown(a, b.min), b.max);
}

// Squared distance of two boxes. A moved box contains the moved vertices because rounding is monotone, so this is a
// lower bound of the distance of the boxes' contents, up to the rounding of double.
double squared_gap(const Box& a, const Box& b) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap =
        std::max(static_cast<double>(a.min[axis]) - b.max[axis], static_cast<double>(b.min[axis]) - a.max[axis]);
    if (gap > 0.0) sum += gap * gap;
  }
  return sum;
}

void visit_triangles(const TriangleTree& a, Vec3 xa, std::uint32_t a_begin, std::uint32_t a_end, const TriangleTree& b,
                     Vec3 xb, std::uint32_t b_begin, std::uint32_t b_end, Nearest& best) {
  for (std::uint32_t i = a_begin; i < a_end; ++i) {
    const Corners corners_a = corners_of(a, i, xa);
    for (std::uint32_t j = b_begin; j < b_end && best.squared_m2 > 0.0; ++j) {
      const Nearest found = nearest_of_triangles(corners_a, corners_of(b, j, xb));
      if (found.squared_m2 < best.squared_m2) best = found;
    }
  }
}

}  // namespace

TriangleTree::TriangleTree(const core::Mesh& mesh, core::Quat orientation)
    : vertices_(mesh.vertices), triangles_(mesh.triangles) {
  for (Vec3& v : vertices_) v = core::rotate(orientation, v);
  nodes_.reserve(triangles_.size());
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

// Splits at the median of the box centers on the longest axis. nth_element may order equal keys in any way, but always
// in the same way: the tree depends on the mesh alone.
void TriangleTree::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Box box = core::empty_box();
  for (std::uint32_t k = begin; k < end; ++k) box = joined(box, box_of(vertices_, triangles_[k]));
  nodes_[node].box = box;
  if (end - begin <= kLeafTriangles) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const Vec3 size = box.max - box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const auto middle = [&](const Triangle& t) {
    const Box b = box_of(vertices_, t);
    return b.min[axis] + b.max[axis];
  };
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
                   [&](const Triangle& p, const Triangle& q) { return middle(p) < middle(q); });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(child, begin, half);
  split(child + 1, half, end);
}

Corners corners_of(const TriangleTree& tree, std::uint32_t k, Vec3 x) {
  const Triangle& t = tree.triangles()[k];
  const std::vector<Vec3>& v = tree.vertices();
  return {to_point(v[t[0]] + x), to_point(v[t[1]] + x), to_point(v[t[2]] + x)};
}

// Depth first, nearer children first, so that a small distance is found early and lets the rest be skipped.
Nearest nearest_of_trees(const TriangleTree& a, Vec3 xa, const TriangleTree& b, Vec3 xb) {
  struct Visit {
    std::uint32_t node_a, node_b;
    double squared_gap;
  };
  const auto visit = [&](std::uint32_t node_a, std::uint32_t node_b) {
    return Visit{node_a, node_b,
                 squared_gap(core::translated(a.nodes()[node_a].box, xa), core::translated(b.nodes()[node_b].box, xb))};
  };
  Nearest best = kBeyond;
  std::vector<Visit> open{visit(0, 0)};
  while (!open.empty() && best.squared_m2 > 0.0) {
    const Visit now = open.back();
    open.pop_back();
    if (now.squared_gap >= best.squared_m2) continue;
    const TriangleTree::Node& node_a = a.nodes()[now.node_a];
    const TriangleTree::Node& node_b = b.nodes()[now.node_b];
    if (node_a.count > 0 && node_b.count > 0) {
      visit_triangles(a, xa, node_a.first, node_a.first + node_a.count, b, xb, node_b.first,
                      node_b.first + node_b.count, best);
      continue;
    }
    // Open the node with the larger box; the other node is paired with each of its children.
    const Vec3 size_a = node_a.box.max - node_a.box.min;
    const Vec3 size_b = node_b.box.max - node_b.box.min;
    const bool opens_a =
        node_b.count > 0 || (node_a.count == 0 && core::dot(size_a, size_a) >= core::dot(size_b, size_b));
    Visit near = opens_a ? visit(node_a.first, now.node_b) : visit(now.node_a, node_b.first);
    Visit far = opens_a ? visit(node_a.first + 1, now.node_b) : visit(now.node_a, node_b.first + 1);
    if (far.squared_gap < near.squared_gap) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return best;
}

Nearest nearest_by_brute_force(const TriangleTree& a, Vec3 xa, const TriangleTree& b, Vec3 xb) {
  Nearest best = kBeyond;
  visit_triangles(a, xa, 0, static_cast<std::uint32_t>(a.triangles().size()), b, xb, 0,
                  static_cast<std::uint32_t>(b.triangles().size()), best);
  return best;
}

Nearest nearest_vertices(const TriangleTree& a, Vec3 xa, const TriangleTree& b, Vec3 xb) {
  // Separate columns and eight running minima, so that the inner loop has neither branches nor a fixed order of
  // additions.
  constexpr std::size_t kLanes = 8;
  const std::size_t padded = (b.vertices().size() + kLanes - 1) / kLanes * kLanes;
  std::array<std::vector<double>, 3> column;
  for (int axis = 0; axis < 3; ++axis) {
    column[axis].assign(padded, std::numeric_limits<double>::infinity());
    for (std::size_t j = 0; j < b.vertices().size(); ++j) column[axis][j] = (b.vertices()[j] + xb)[axis];
  }
  Nearest best = kBeyond;
  for (const Vec3 v : a.vertices()) {
    const Point p = to_point(v + xa);
    std::array<double, kLanes> least;
    least.fill(best.squared_m2);
    for (std::size_t j = 0; j < padded; j += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double dx = p.x - column[0][j + lane];
        const double dy = p.y - column[1][j + lane];
        const double dz = p.z - column[2][j + lane];
        const double squared = dx * dx + dy * dy + dz * dz;
        least[lane] = squared < least[lane] ? squared : least[lane];
      }
    }
    if (*std::min_element(least.begin(), least.end()) >= best.squared_m2) continue;
    for (const Vec3 w : b.vertices()) {
      const Point q = to_point(w + xb);
      const double squared = dot(p - q, p - q);
      if (squared < best.squared_m2) best = {squared, p, q};
    }
  }
  return best;
}

}  // namespace broadside::exact
