#include "core/scene/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/exact/triangle_distance.hpp"
#include "core/method/rigid/mesh_manifold.hpp"

namespace broadside::core {
namespace {

using exact::Point;

constexpr std::size_t kLeafTriangles = 4;

Point across(const Mesh& mesh, const Triangle& t) {
  const Point a = exact::to_point(mesh.vertices[t[0]]);
  return cross(exact::to_point(mesh.vertices[t[1]]) - a, exact::to_point(mesh.vertices[t[2]]) - a);
}

class Tree {
 public:
  explicit Tree(const Mesh& mesh) : mesh_(mesh) {
    for (const Triangle& t : mesh.triangles) {
      const Point n = across(mesh, t);
      if (dot(n, n) > 0.0) order_.push_back(t);
    }
  }

  TriangleTables tables() {
    out_.nodes.emplace_back();
    split(0, 0, order_.size());
    for (const Triangle& t : order_) {
      out_.triangles.insert(out_.triangles.end(), t.begin(), t.end());
      const Point n = across(mesh_, t);
      const double size = std::sqrt(dot(n, n));
      out_.normals.push_back(
          {static_cast<float>(n.x / size), static_cast<float>(n.y / size), static_cast<float>(n.z / size)});
    }
    look_beyond();
    cone_below(0);
    return std::move(out_);
  }

 private:
  [[nodiscard]] double middle(const Triangle& t, int axis) const {
    return static_cast<double>(mesh_.vertices[t[0]][axis]) + mesh_.vertices[t[1]][axis] + mesh_.vertices[t[2]][axis];
  }

  void split(std::size_t node, std::size_t begin, std::size_t end) {
    Box box = empty_box();
    for (std::size_t k = begin; k < end; ++k)
      for (const std::uint32_t v : order_[k]) box = grown(box, mesh_.vertices[v]);
    out_.nodes[node].min = box.min;
    out_.nodes[node].max = box.max;
    if (end - begin <= kLeafTriangles) {
      out_.nodes[node].first = static_cast<std::uint32_t>(begin);
      out_.nodes[node].count = static_cast<std::uint32_t>(end - begin);
      return;
    }
    const Vec3 size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto from = order_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to = order_.begin() + static_cast<std::ptrdiff_t>(end);
    std::stable_sort(from, to, [&](const Triangle& p, const Triangle& q) { return middle(p, axis) < middle(q, axis); });
    const std::size_t first = out_.nodes.size();
    out_.nodes[node].first = static_cast<std::uint32_t>(first);
    out_.nodes.resize(first + 2);
    const std::size_t half = begin + (end - begin) / 2;
    split(first, begin, half);
    split(first + 1, half, end);
  }

  // An edge is convex where the neighboring triangle's third corner is behind this triangle's plane.
  void look_beyond() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> beside;
    for (std::size_t t = 0; t < order_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) beside[{order_[t][k], order_[t][(k + 1) % 3]}] = t;
    for (std::size_t t = 0; t < order_.size(); ++t) {
      float least = 1.0F;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto found = beside.find({order_[t][(k + 1) % 3], order_[t][k]});
        if (found == beside.end()) {
          least = 0.0F;  // a boundary edge is convex to all sides
          continue;
        }
        for (const std::uint32_t v : order_[found->second]) {
          const bool is_behind = dot(out_.normals[t], mesh_.vertices[v] - mesh_.vertices[order_[t][k]]) < 0.0F;
          if (is_behind) least = std::min(least, dot(out_.normals[t], out_.normals[found->second]));
        }
      }
      out_.least_facing.push_back(least);
    }
  }

  // Sets the cones of the node and its descendants; returns the index of its first triangle and one past its last.
  std::pair<std::size_t, std::size_t> cone_below(std::size_t at) {
    TriangleNode& node = out_.nodes[at];
    const std::size_t first = node.first;
    const auto [begin, end] = node.count > 0 ? std::pair{first, first + node.count}
                                             : std::pair{cone_below(first).first, cone_below(first + 1).second};
    // Covers rounding of the normals, of this computation and of the test.
    constexpr double kSlack = 1e-5;
    Point sum;
    for (std::size_t t = begin; t < end; ++t) sum = sum + exact::to_point(out_.normals[t]);
    const double size = std::sqrt(dot(sum, sum));
    if (!(size > 0.0)) return {begin, end};
    const Point middle = (1.0 / size) * sum;
    double widest = 0.0;
    for (std::size_t t = begin; t < end; ++t) {
      const double aside = std::acos(std::clamp(dot(middle, exact::to_point(out_.normals[t])), -1.0, 1.0));
      const double looks = std::acos(static_cast<double>(mesh_detail::least_looking(out_.least_facing[t])));
      widest = std::max(widest, aside + looks + kSlack);
    }
    if (!(widest < 0.5 * std::numbers::pi)) return {begin, end};
    node.looking = {static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)};
    node.least_looking = static_cast<float>(std::cos(widest));
    return {begin, end};
  }

  const Mesh& mesh_;
  std::vector<Triangle> order_;
  TriangleTables out_;
};

}  // namespace

TriangleTables triangle_tables(const Mesh& mesh) {
  return Tree(mesh).tables();
}

}  // namespace broadside::core
