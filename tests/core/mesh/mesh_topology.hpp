// Facts about a triangle mesh that a closed, outward-facing surface must have.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "core/scene/mesh.hpp"

namespace broadside::tests {

// Every directed edge is used once and its reverse once: closed, manifold along edges, consistently turned.
inline bool is_closed(const core::Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const core::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end()) return false;
  }
  return !uses.empty();
}

// By the divergence theorem; positive when the triangles face outward.
inline double volume_m3(const core::Mesh& mesh) {
  double six_volumes = 0.0;
  for (const core::Triangle& t : mesh.triangles) {
    const core::Vec3 a = mesh.vertices[t[0]];
    const core::Vec3 b = mesh.vertices[t[1]];
    const core::Vec3 c = mesh.vertices[t[2]];
    six_volumes += double{a.x} * (double{b.y} * c.z - double{b.z} * c.y) +
                   double{a.y} * (double{b.z} * c.x - double{b.x} * c.z) +
                   double{a.z} * (double{b.x} * c.y - double{b.y} * c.x);
  }
  return six_volumes / 6.0;
}

inline std::int64_t euler_characteristic(const core::Mesh& mesh) {
  // Closed triangle meshes have 3 T = 2 E.
  return static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(mesh.triangles.size()) / 2;
}

}  // namespace broadside::tests
