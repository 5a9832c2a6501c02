#include "datasets/shapes/convex_mesh.hpp"

#include <string>

#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

// Six times the volume of the tetrahedron: positive when d is in front of the triangle a b c. Float corners, computed
// in double. Points on an ellipsoid lie in one plane only by chance.
double volume(core::Vec3 a, core::Vec3 b, core::Vec3 c, core::Vec3 d) {
  const auto minus = [](core::Vec3 p, core::Vec3 q) {
    return std::array<double, 3>{double(p.x) - q.x, double(p.y) - q.y, double(p.z) - q.z};
  };
  const auto u = minus(b, a);
  const auto v = minus(c, a);
  const auto w = minus(d, a);
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
}

// A triangle is a face of the hull when no corner is in front of it. All triangles are tried, because there are few
// corners.
bool is_face(const core::Mesh& mesh, const core::Triangle& t) {
  for (std::uint32_t k = 0; k < mesh.vertices.size(); ++k) {
    if (k == t[0] || k == t[1] || k == t[2]) continue;
    if (volume(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[k]) > 0.0) return false;
  }
  return true;
}

}  // namespace

core::Result<core::Mesh> convex_mesh(std::array<double, 3> sides_m, int corners, std::uint64_t seed) {
  for (const double side : sides_m)
    if (!(side > 0.0)) return core::Error{"a side is not above 0", "convex body"};
  if (corners < 4 || corners > 64)
    return core::Error{"corners are " + std::to_string(corners), "convex body", "give 4 to 64"};
  core::Mesh mesh;
  mesh.name = "convex";
  mesh.source = "procedural";
  RandomStream random(seed);
  for (int k = 0; k < corners; ++k) {
    const auto d = random.direction();
    mesh.vertices.push_back({static_cast<float>(0.5 * sides_m[0] * d.x), static_cast<float>(0.5 * sides_m[1] * d.y),
                             static_cast<float>(0.5 * sides_m[2] * d.z)});
  }
  const auto n = static_cast<std::uint32_t>(corners);
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      for (std::uint32_t c = b + 1; c < n; ++c)
        for (const core::Triangle& t : {core::Triangle{a, b, c}, core::Triangle{a, c, b}})
          if (is_face(mesh, t)) mesh.triangles.push_back(t);
  if (mesh.triangles.size() != 2 * mesh.vertices.size() - 4)
    return core::Error{"corners of this seed lie in one plane", "convex body", "take another seed"};
  return mesh;
}

}  // namespace broadside::datasets
