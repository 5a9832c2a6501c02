#include "core/scene/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/exact/triangle_distance.hpp"

namespace broadside::core {
namespace {

using exact::Point;
using exact::to_point;

double distance(Point a, Point b) {
  return length(a - b);
}

// The covering radius of a triangle by its three vertices, from its side lengths. Acute or right: the circumcenter is
// in the triangle and is the farthest point. Obtuse, with c the longest side: the farthest point is where the
// perpendicular bisector of a shorter side meets c. For side a, its distance from the ends of a is
// a^2 c / (a^2 + c^2 - b^2); of the distances for a and b, the larger one counts.
double triangle_covering_radius(double a, double b, double c) {
  if (a > c) std::swap(a, c);
  if (b > c) std::swap(b, c);
  if (a == 0.0 || b == 0.0) return 0.5 * c;
  if (c * c >= a * a + b * b) {
    const double from_a = a * a * c / (a * a + c * c - b * b);
    const double from_b = b * b * c / (b * b + c * c - a * a);
    return std::max(from_a, from_b);
  }
  const double s = 0.5 * (a + b + c);
  const double area = std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
  return a * b * c / (4.0 * area);
}

}  // namespace

Box bounds(const Mesh& mesh) {
  Box box = empty_box();
  for (const Vec3 v : mesh.vertices) box = grown(box, v);
  return box;
}

float mean_edge_m(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  if (edges.empty()) return 0.0F;
  double sum = 0.0;
  for (const auto& [p, q] : edges) sum += distance(to_point(mesh.vertices[p]), to_point(mesh.vertices[q]));
  return static_cast<float>(sum / static_cast<double>(edges.size()));
}

double covering_radius_m(const Mesh& mesh) {
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Point a = to_point(mesh.vertices[t[0]]);
    const Point b = to_point(mesh.vertices[t[1]]);
    const Point c = to_point(mesh.vertices[t[2]]);
    largest = std::max(largest, triangle_covering_radius(distance(a, b), distance(b, c), distance(c, a)));
  }
  return largest;
}

}  // namespace broadside::core
