#include "core/mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace broadside::core {
namespace {

// Union-find by index, with path halving.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<std::uint32_t> parent_;
};

// One side of one triangle. Corners are numbered 3 * triangle + k.
struct Side {
  std::uint32_t low, high;        // vertices
  std::uint32_t at_low, at_high;  // corners of the triangle at these vertices
  bool is_rising;                 // whether it runs from low to high

  friend bool operator<(const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; }
};

std::vector<Side> sorted_sides(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[t][k];
      const std::uint32_t to = mesh.triangles[t][(k + 1) % 3];
      const std::uint32_t at_from = 3 * t + k;
      const std::uint32_t at_to = 3 * t + (k + 1) % 3;
      sides.push_back(from < to ? Side{from, to, at_from, at_to, true} : Side{to, from, at_to, at_from, false});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

using Coordinates = std::array<double, 3>;

Coordinates point(Vec3 v) {
  return {v.x, v.y, v.z};
}
Coordinates cross(const Coordinates& a, const Coordinates& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Topology topology(const Mesh& mesh) {
  Topology t;
  Groups components(mesh.vertices.size());
  Groups fans(3 * mesh.triangles.size());
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && !(sides[first] < sides[last])) ++last;
    ++t.edges;
    if (last - first == 1) ++t.boundary_edges;
    if (last - first > 2) ++t.non_manifold_edges;
    if (last - first == 2 && sides[first].is_rising == sides[first + 1].is_rising) ++t.misoriented_edges;
    components.join(sides[first].low, sides[first].high);
    for (std::size_t k = first + 1; k < last; ++k) {
      fans.join(sides[first].at_low, sides[k].at_low);
      fans.join(sides[first].at_high, sides[k].at_high);
    }
    first = last;
  }
  // The first fan of each vertex, and whether it has another fan.
  constexpr std::uint32_t kNoFan = 0xFFFFFFFFU;
  std::vector<std::uint32_t> fan_of(mesh.vertices.size(), kNoFan);
  std::vector<bool> is_counted(mesh.vertices.size(), false);
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[n][k];
      const std::uint32_t fan = fans.root(3 * n + k);
      if (fan_of[vertex] == kNoFan) fan_of[vertex] = fan;
      if (fan_of[vertex] == fan || is_counted[vertex]) continue;
      is_counted[vertex] = true;
      ++t.non_manifold_vertices;
    }
  std::int64_t named = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (fan_of[v] == kNoFan) continue;
    ++named;
    if (components.root(v) == v) ++t.components;
  }
  t.euler_characteristic =
      named - static_cast<std::int64_t>(t.edges) + static_cast<std::int64_t>(mesh.triangles.size());
  return t;
}

double signed_volume_m3(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Coordinates a = point(mesh.vertices[t[0]]);
    const Coordinates n = cross(point(mesh.vertices[t[1]]), point(mesh.vertices[t[2]]));
    six_volumes += (a[0] * n[0] + a[1] * n[1]) + a[2] * n[2];
  }
  return six_volumes / 6.0;
}

double area_m2(const Mesh& mesh) {
  double twice = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Coordinates a = point(mesh.vertices[t[0]]);
    Coordinates p = point(mesh.vertices[t[1]]);
    Coordinates q = point(mesh.vertices[t[2]]);
    for (int k = 0; k < 3; ++k) p[k] -= a[k], q[k] -= a[k];
    const Coordinates n = cross(p, q);
    twice += std::sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
  }
  return 0.5 * twice;
}

}  // namespace broadside::core
