#include "core/scene/mass_properties.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

#include "core/exact/convex_hull.hpp"
#include "core/exact/self_crossing.hpp"
#include "core/mesh/topology.hpp"
#include "core/scene/primitive.hpp"

namespace broadside::core {
namespace {

using Position = std::array<double, 3>;

Position point_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

// Volume and the integrals of x_i and x_i x_j over the volume, summed over the tetrahedra between the origin and each
// triangle.
struct Moments {
  double volume = 0.0;
  Position first{};
  std::array<double, 6> second{};  // xx yy zz xy xz yz
};

Moments moments_of(const Mesh& mesh) {
  constexpr std::array<std::array<int, 2>, 6> kAxes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  Moments sum;
  for (const Triangle& t : mesh.triangles) {
    const std::array<Position, 3> p{point_of(mesh.vertices[t[0]]), point_of(mesh.vertices[t[1]]),
                                    point_of(mesh.vertices[t[2]])};
    const double determinant = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
                               p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
                               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    sum.volume += determinant / 6.0;
    for (std::size_t k = 0; k < 3; ++k) sum.first[k] += determinant / 24.0 * (p[0][k] + p[1][k] + p[2][k]);
    for (std::size_t e = 0; e < kAxes.size(); ++e) {
      const auto [i, j] = kAxes[e];
      const double total_i = p[0][i] + p[1][i] + p[2][i];
      const double total_j = p[0][j] + p[1][j] + p[2][j];
      double products = total_i * total_j;
      for (const Position& q : p) products += q[i] * q[j];
      sum.second[e] += determinant / 120.0 * products;
    }
  }
  return sum;
}

MassProperties of_polyhedron(const Moments& m, double mass_kg) {
  const double density = mass_kg / m.volume;
  MassProperties out;
  for (std::size_t k = 0; k < 3; ++k) out.center_of_mass_m[k] = m.first[k] / m.volume;
  const Position& c = out.center_of_mass_m;
  // Second moments about the center of mass.
  const auto about = [&](std::size_t e, std::size_t i, std::size_t j) {
    return density * m.second[e] - mass_kg * c[i] * c[j];
  };
  const double xx = about(0, 0, 0);
  const double yy = about(1, 1, 1);
  const double zz = about(2, 2, 2);
  out.inertia_kg_m2 = {yy + zz, xx + zz, xx + yy, -about(3, 0, 1), -about(4, 0, 2), -about(5, 1, 2)};
  return out;
}

MassProperties of_primitive(const Primitive& p, double mass_kg) {
  MassProperties out;
  const Position h = point_of(p.half_extents);
  if (p.kind == PrimitiveKind::kBox) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = h[(k + 1) % 3];
      const double b = h[(k + 2) % 3];
      out.inertia_kg_m2[k] = mass_kg * (a * a + b * b) / 3.0;
    }
    return out;
  }
  const double r = p.radius_m;
  if (p.kind == PrimitiveKind::kSphere) {
    for (std::size_t k = 0; k < 3; ++k) out.inertia_kg_m2[k] = 0.4 * mass_kg * r * r;
    return out;
  }
  if (p.kind == PrimitiveKind::kCylinder) {
    const double half = p.half_length_m();
    for (std::size_t k = 0; k < 3; ++k)
      out.inertia_kg_m2[k] =
          static_cast<int>(k) == p.axis ? 0.5 * mass_kg * r * r : mass_kg * (r * r / 4.0 + half * half / 3.0);
    return out;
  }
  // A capsule is a cylinder of length 2 l and two half balls.
  const double l = p.half_length_m();
  const double cylinder = 2.0 * std::numbers::pi * r * r * l;
  const double ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double m_c = mass_kg * cylinder / (cylinder + ball);
  const double m_b = mass_kg - m_c;
  const double along = m_c * r * r / 2.0 + m_b * 0.4 * r * r;
  const double across = m_c * (r * r / 4.0 + l * l / 3.0) + m_b * (0.4 * r * r + l * l + 0.75 * l * r);
  for (std::size_t k = 0; k < 3; ++k) out.inertia_kg_m2[k] = static_cast<int>(k) == p.axis ? along : across;
  return out;
}

// Every load of a scene asks this four times for each mesh, and for a million triangles the answer takes seconds. So it
// is kept for this process, by a hash of what it depends on.
bool crosses_itself(const Mesh& mesh) {
  static std::mutex mutex;
  static std::map<std::pair<std::uint64_t, std::uint64_t>, bool> known;
  const XXH128_hash_t points = XXH3_128bits(mesh.vertices.data(), mesh.vertices.size() * sizeof(mesh.vertices[0]));
  const XXH128_hash_t both = XXH3_128bits_withSeed(
      mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]), points.low64 ^ points.high64);
  const std::pair key{both.low64, both.high64};
  {
    const std::lock_guard lock(mutex);
    if (const auto at = known.find(key); at != known.end()) return at->second;
  }
  const bool crosses = exact::crosses_itself(mesh);
  const std::lock_guard lock(mutex);
  known.emplace(key, crosses);
  return crosses;
}

// Why the volume enclosed by the mesh's triangles is not a solid; empty when it is one.
std::string why_hull(const Mesh& mesh) {
  const Topology surface = topology(mesh);
  if (!surface.is_closed()) return "the mesh is open";
  if (surface.misoriented_edges > 0) return "the mesh's triangles are not all wound the same way";
  if (!(moments_of(mesh).volume > 0.0)) return "the mesh encloses no positive volume";
  return crosses_itself(mesh) ? "the mesh crosses itself" : "";
}

}  // namespace

Result<UniformSolid> uniform_solid(const Mesh& mesh, double mass_kg) {
  if (const auto primitive = primitive_of(mesh))
    return UniformSolid{of_primitive(*primitive, mass_kg), Solid::kPrimitive, {}};
  const std::string fault = why_hull(mesh);
  if (fault.empty()) return UniformSolid{of_polyhedron(moments_of(mesh), mass_kg), Solid::kMesh, {}};
  const auto hull = exact::convex_hull(mesh.vertices);
  const Moments moments = hull ? moments_of(*hull) : Moments{};
  if (!(moments.volume > 0.0))
    return Error{"the mesh is flat, so its inertia is not defined", "mesh " + mesh.name,
                 "give center_of_mass_m and inertia_kg_m2 of its bodies, or a mesh with a volume"};
  return UniformSolid{of_polyhedron(moments, mass_kg), Solid::kHull, fault};
}

Result<MassProperties> uniform_mass_properties(const Mesh& mesh, double mass_kg) {
  auto solid = uniform_solid(mesh, mass_kg);
  if (!solid) return solid.error();
  return solid.value().properties;
}

std::array<double, 3> principal_moments(const std::array<double, 6>& m) {
  // Eigenvalues of a symmetric 3 x 3 matrix by its characteristic cubic (Smith, Communications of the ACM 4, 1961).
  const double off = m[3] * m[3] + m[4] * m[4] + m[5] * m[5];
  const double mean = (m[0] + m[1] + m[2]) / 3.0;
  const double a = m[0] - mean;
  const double b = m[1] - mean;
  const double c = m[2] - mean;
  const double p = std::sqrt((a * a + b * b + c * c + 2.0 * off) / 6.0);
  if (p == 0.0) return {mean, mean, mean};
  const double determinant =
      a * (b * c - m[5] * m[5]) - m[3] * (m[3] * c - m[5] * m[4]) + m[4] * (m[3] * m[5] - b * m[4]);
  const double angle = std::acos(std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0)) / 3.0;
  const double third = 2.0 * std::numbers::pi / 3.0;
  const double high = mean + 2.0 * p * std::cos(angle);
  const double low = mean + 2.0 * p * std::cos(angle + third);
  return {low, 3.0 * mean - high - low, high};
}

Status check_mass_properties(const MassProperties& properties) {
  for (const double v : properties.center_of_mass_m)
    if (!std::isfinite(v)) return Error{"center_of_mass_m is NaN or infinite", "", "give three finite numbers, in m"};
  for (const double v : properties.inertia_kg_m2)
    if (!std::isfinite(v)) return Error{"inertia_kg_m2 is NaN or infinite", "", "give xx yy zz xy xz yz, in kg m^2"};
  const auto [low, middle, high] = principal_moments(properties.inertia_kg_m2);
  if (!(low > 0.0)) return Error{"inertia_kg_m2 has a principal moment of zero or below", "", "give a positive matrix"};
  if (!(high <= (low + middle) * (1.0 + 0x1p-20)))
    return Error{
        "inertia_kg_m2 breaks the triangle inequality: its largest principal moment is above the sum of the others", "",
        "no body has such an inertia: check the units and the order xx yy zz xy xz yz"};
  return Done{};
}

}  // namespace broadside::core
