#include "datasets/generators/small_scene_parts.hpp"

#include <utility>

#include "datasets/generators/scene_options.hpp"
#include "datasets/shapes/box_mesh.hpp"

namespace broadside::datasets {
namespace {

constexpr double kCut_m = 0.125;

}  // namespace

std::shared_ptr<const core::Mesh> cut_box(std::array<double, 3> sides_m) {
  std::array<int, 3> segments;
  for (int k = 0; k < 3; ++k) segments[k] = static_cast<int>(sides_m[k] / kCut_m);
  // The sides are literals of this folder, so an invalid one ends the program in value().
  return std::make_shared<const core::Mesh>(std::move(box_mesh(sides_m, segments)).value());
}

core::Scene around_origin(std::uint32_t frames) {
  core::Scene scene;
  scene.meshes.push_back(cut_box({1.0, 1.0, 1.0}));
  scene.domain = {{-4.0F, -4.0F, -4.0F}, {4.0F, 4.0F, 4.0F}};
  scene.frames = frames;
  return scene;
}

core::Scene over_floor(std::uint32_t frames) {
  core::Scene scene = around_origin(frames);
  scene.domain = {{-12.0F, 0.0F, -4.0F}, {12.0F, 8.0F, 4.0F}};
  scene.gravity_m_s2 = kGravity;
  return scene;
}

void add(core::Scene& scene, core::Vec3 position, core::Vec3 velocity, float inverse_mass, std::uint32_t mesh) {
  core::Body body;
  body.mesh = mesh;
  body.position = position;
  body.velocity = velocity;
  body.inverse_mass = inverse_mass;
  scene.bodies.push_back(body);
}

}  // namespace broadside::datasets
