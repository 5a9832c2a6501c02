#include "datasets/shapes/cylinder_mesh.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "datasets/circle.hpp"

namespace broadside::datasets {

core::Result<core::Mesh> cylinder_mesh(double radius_m, double half_length_m, int sides) {
  if (!(radius_m > 0.0) || !std::isfinite(radius_m) || !(half_length_m > 0.0) || !std::isfinite(half_length_m))
    return core::Error{"radius and half length must be finite and above 0", "cylinder"};
  if (sides < 12 || sides > 4096 || sides % 4 != 0)
    return core::Error{"sides are " + std::to_string(sides), "cylinder", "give a multiple of 4 from 12 to 4096"};
  core::Mesh mesh;
  mesh.name = "cylinder";
  mesh.source = "procedural: cylinder of " + std::to_string(sides) + " sides";
  const auto z = static_cast<float>(half_length_m);
  mesh.vertices = {{0.0F, 0.0F, -z}, {0.0F, 0.0F, z}};
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Turn turn = part_of_circle(k, n);
    const auto x = static_cast<float>(radius_m * turn.cosine);
    const auto y = static_cast<float>(radius_m * turn.sine);
    mesh.vertices.push_back({x, y, -z});
    mesh.vertices.push_back({x, y, z});
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t low = 2 + 2 * k;
    const std::uint32_t next = 2 + 2 * ((k + 1) % n);
    mesh.triangles.push_back({0, next, low});
    mesh.triangles.push_back({1, low + 1, next + 1});
    mesh.triangles.push_back({low, next, next + 1});
    mesh.triangles.push_back({low, next + 1, low + 1});
  }
  return mesh;
}

}  // namespace broadside::datasets
