// The nearest vertices of two bodies by an exact search: the validators' own, in float64.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/math/vec3.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {

// A tree of bounding boxes over the vertices of one body, in body coordinates, built by halving along the longest side.
class VertexTree {
 public:
  explicit VertexTree(std::span<const core::Vec3> vertices);

  // The smallest distance between a vertex of this body and one of `other`, if it is below `below`; otherwise `below`.
  // Both bodies stand at their positions, m.
  [[nodiscard]] double nearest(Vec3d position, const VertexTree& other, Vec3d other_position, double below) const;

  // Each vertex of this body with each of `other` that is no farther away than this, by their numbers in the given
  // lists, in no order.
  void visit_within(Vec3d position, const VertexTree& other, Vec3d other_position, double distance,
                    const std::function<void(std::uint32_t, std::uint32_t)>& visit) const;

 private:
  struct Node {
    Vec3d min;
    Vec3d max;
    std::uint32_t first;
    std::uint32_t last;
    std::int32_t child;  // of two neighbors; -1 = leaf
  };

  void build(std::uint32_t node);
  // Calls see(vertex, other's vertex, squared distance), which may lower the bound.
  template <typename See>
  void search(std::uint32_t node, const VertexTree& other, std::uint32_t other_node, Vec3d offset, const double& bound2,
              See& see) const;

  struct Point {
    Vec3d at;
    std::uint32_t vertex;
  };
  std::vector<Point> points_;
  std::vector<Node> nodes_;
};

}  // namespace broadside::validation
