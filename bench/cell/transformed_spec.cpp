#include "bench/cell/transformed_spec.hpp"

#include <cstdint>
#include <numeric>
#include <vector>

#include "core/scene/transformed_scene.hpp"

namespace broadside::bench {
namespace {

using core::Scene;

Scene renumbered(const Scene& scene) {
  std::vector<std::uint32_t> order(scene.bodies.size());
  std::iota(order.rbegin(), order.rend(), 0U);
  return core::renumbered_scene(scene, order);
}

constexpr TransformationRow kTable[] = {
    {"mirrored-x", "x to -x", [](const Scene& s) { return core::mirrored_scene(s, 0); }},
    {"mirrored-y", "y to -y", [](const Scene& s) { return core::mirrored_scene(s, 1); }},
    {"mirrored-z", "z to -z", [](const Scene& s) { return core::mirrored_scene(s, 2); }},
    {"turned-x", "turned by 90 degrees about x", [](const Scene& s) { return core::turned_scene(s, 0); }},
    {"turned-y", "turned by 90 degrees about y", [](const Scene& s) { return core::turned_scene(s, 1); }},
    {"turned-z", "turned by 90 degrees about z", [](const Scene& s) { return core::turned_scene(s, 2); }},
    {"doubled", "every length twice as large", [](const Scene& s) { return core::scaled_scene(s, 2.0F); }},
    {"halved", "every length half as large", [](const Scene& s) { return core::scaled_scene(s, 0.5F); }},
    {"renumbered", "bodies in reverse order", renumbered},
    {"grown", "meshes a quarter larger", [](const Scene& s) { return core::grown_scene(s, 1.25F); }},
};

}  // namespace

std::span<const TransformationRow> transformations() {
  return kTable;
}

std::pair<std::string_view, const TransformationRow*> split_transformation(std::string_view spec) {
  const std::size_t at = spec.rfind('@');
  if (at != std::string_view::npos)
    for (const TransformationRow& row : kTable)
      if (row.name == spec.substr(at + 1)) return {spec.substr(0, at), &row};
  return {spec, nullptr};
}

}  // namespace broadside::bench
