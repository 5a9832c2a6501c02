#include "core/exact/sphere_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace broadside::exact {
namespace {

// A radius is the root of a sum of squares. This factor covers its few roundings more than the distance's, so that the
// radius is never below the distance.
constexpr double kNoLess = 1.0 + 0x1p-49;

class Builder {
 public:
  explicit Builder(SphereTree& tree) : tree_(tree), order_(tree.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
  }

  void build() {
    if (order_.empty()) return;
    tree_.nodes.emplace_back();
    split(0, 0, static_cast<std::uint32_t>(order_.size()));
  }

 private:
  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    Point low = tree_.triangles[order_[begin]][0];
    Point high = low;
    for_corners(begin, end, [&](Point p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    });
    const Point center = 0.5 * (low + high);
    double squared = 0.0;
    for_corners(begin, end, [&](Point p) { squared = std::max(squared, dot(p - center, p - center)); });
    tree_.nodes[node].center = center;
    tree_.nodes[node].radius_m = kNoLess * std::sqrt(squared);
    if (end - begin == 1) {
      tree_.nodes[node].first = order_[begin];
      tree_.nodes[node].is_leaf = true;
      return;
    }
    const Point size = high - low;
    const auto middle = [&](std::uint32_t k) {
      const Point sum = tree_.triangles[k][0] + tree_.triangles[k][1] + tree_.triangles[k][2];
      return size.x >= size.y && size.x >= size.z ? sum.x : (size.y >= size.z ? sum.y : sum.z);
    };
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](std::uint32_t p, std::uint32_t q) { return middle(p) < middle(q); });
    const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes[node].first = child;
    tree_.nodes.resize(child + 2);
    split(child, begin, half);
    split(child + 1, half, end);
  }

  template <typename Visit>
  void for_corners(std::uint32_t begin, std::uint32_t end, const Visit& visit) const {
    for (std::uint32_t k = begin; k < end; ++k)
      for (const Point p : tree_.triangles[order_[k]]) visit(p);
  }

  SphereTree& tree_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

SphereTree make_sphere_tree(const core::Mesh& mesh) {
  SphereTree tree;
  tree.triangles.reserve(mesh.triangles.size());
  for (const core::Triangle& t : mesh.triangles)
    tree.triangles.push_back(
        {to_point(mesh.vertices[t[0]]), to_point(mesh.vertices[t[1]]), to_point(mesh.vertices[t[2]])});
  Builder(tree).build();
  return tree;
}

}  // namespace broadside::exact
