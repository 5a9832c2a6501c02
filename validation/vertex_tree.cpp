#include "validation/vertex_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace broadside::validation {
namespace {

// Small enough that a pair of leaves costs less than two more levels of boxes.
constexpr std::uint32_t kLeafSize = 8;

double gap(double a_min, double a_max, double b_min, double b_max) {
  return std::max({0.0, a_min - b_max, b_min - a_max});
}

}  // namespace

VertexTree::VertexTree(std::span<const core::Vec3> vertices) {
  for (const core::Vec3 v : vertices) points_.push_back({Vec3d(v), static_cast<std::uint32_t>(points_.size())});
  if (points_.empty()) return;
  nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(points_.size()), -1});
  build(0);
}

void VertexTree::build(std::uint32_t index) {
  const std::uint32_t first = nodes_[index].first;
  const std::uint32_t last = nodes_[index].last;
  Vec3d low = points_[first].at;
  Vec3d high = points_[first].at;
  for (std::uint32_t k = first + 1; k < last; ++k) {
    const Vec3d p = points_[k].at;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  nodes_[index].min = low;
  nodes_[index].max = high;
  if (last - first <= kLeafSize) return;

  const Vec3d side = high - low;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : (side.y >= side.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(points_.begin() + first, points_.begin() + middle, points_.begin() + last,
                   [axis](const Point& p, const Point& q) { return p.at[axis] < q.at[axis]; });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].child = static_cast<std::int32_t>(child);
  nodes_.push_back({{}, {}, first, middle, -1});
  nodes_.push_back({{}, {}, middle, last, -1});
  build(child);
  build(child + 1);
}

double VertexTree::nearest(Vec3d position, const VertexTree& other, Vec3d other_position, double below) const {
  if (nodes_.empty() || other.nodes_.empty() || !(below > 0.0)) return below;
  double best2 = below * below;
  const double unbeaten = best2;
  auto see = [&best2](std::uint32_t, std::uint32_t, double d2) { best2 = std::min(best2, d2); };
  search(0, other, 0, position - other_position, best2, see);
  return best2 < unbeaten ? std::sqrt(best2) : below;
}

void VertexTree::visit_within(Vec3d position, const VertexTree& other, Vec3d other_position, double distance,
                              const std::function<void(std::uint32_t, std::uint32_t)>& visit) const {
  if (nodes_.empty() || other.nodes_.empty() || !(distance >= 0.0)) return;
  // Boxes at the distance itself are opened too.
  const double bound2 = std::nextafter(distance * distance, std::numeric_limits<double>::infinity());
  auto see = [&](std::uint32_t a, std::uint32_t b, double d2) {
    if (d2 < bound2) visit(a, b);
  };
  search(0, other, 0, position - other_position, bound2, see);
}

// offset: added to this body's points, it brings them into the other's coordinates.
template <typename See>
void VertexTree::search(std::uint32_t index, const VertexTree& other, std::uint32_t other_index, Vec3d offset,
                        const double& bound2, See& see) const {
  const Node& a = nodes_[index];
  const Node& b = other.nodes_[other_index];
  const Vec3d low = a.min + offset;
  const Vec3d high = a.max + offset;
  const Vec3d apart{gap(low.x, high.x, b.min.x, b.max.x), gap(low.y, high.y, b.min.y, b.max.y),
                    gap(low.z, high.z, b.min.z, b.max.z)};
  if (!(dot(apart, apart) < bound2)) return;
  if (a.child < 0 && b.child < 0) {
    for (std::uint32_t p = a.first; p < a.last; ++p) {
      const Vec3d at = points_[p].at + offset;
      for (std::uint32_t q = b.first; q < b.last; ++q) {
        const Vec3d d = at - other.points_[q].at;
        see(points_[p].vertex, other.points_[q].vertex, dot(d, d));
      }
    }
    return;
  }
  // The larger node is opened, so both shrink together.
  const bool open_a = b.child < 0 || (a.child >= 0 && a.last - a.first >= b.last - b.first);
  for (std::uint32_t k = 0; k < 2; ++k) {
    if (open_a)
      search(static_cast<std::uint32_t>(a.child) + k, other, other_index, offset, bound2, see);
    else
      search(index, other, static_cast<std::uint32_t>(b.child) + k, offset, bound2, see);
  }
}

}  // namespace broadside::validation
