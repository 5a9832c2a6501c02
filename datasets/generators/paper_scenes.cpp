#include "datasets/generators/paper_scenes.hpp"

#include <memory>
#include <string>
#include <utility>

#include "core/mesh/clean_mesh.hpp"
#include "datasets/generators/start_grid.hpp"

namespace broadside::datasets {
namespace {

using core::Result;
using core::Scene;

// METHOD section 9: the longest side of every mesh's box; the hash cell of 0.25 m is then a quarter of a body.
constexpr double kLongestSide_m = 1.0;

Result<Scene> one_mesh_scene(std::string_view family, std::string_view mesh_name, std::uint32_t count,
                             const SceneOptions& options) {
  Result<core::Mesh> mesh = acquire_mesh(mesh_name, options.meshes);
  if (!mesh) return mesh.error();
  Scene scene;
  scene.name = std::string(family) + ":" + std::string(mesh_name) + ":" + std::to_string(count);
  scene.meshes.push_back(std::make_shared<const core::Mesh>(core::normalized(std::move(mesh).value(), kLongestSide_m)));
  scene.frames = options.frames.value_or(kPaperFrames);
  scene.seed = options.seed.value_or(kDefaultSeed);
  return scene;
}

void place(Scene& scene, const Start& start) {
  scene.domain = start.domain;
  scene.bodies.resize(start.positions.size());
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    scene.bodies[n].position = start.positions[n];
    scene.bodies[n].velocity = start.velocities[n];
  }
}

}  // namespace

Result<Scene> freefall_scene(std::string_view mesh, std::uint32_t count, const SceneOptions& options) {
  Result<Scene> made = one_mesh_scene("freefall", mesh, count, options);
  if (!made) return made;
  Scene& scene = made.value();
  scene.description = std::to_string(count) + " bodies fall from a jittered grid and pile up on the floor";
  scene.gravity_m_s2 = kGravity;
  place(scene, stacked_grid(core::bounds(*scene.meshes[0]), count, StackedGrid{}, scene.seed));
  return made;
}

Result<Scene> random_move_scene(std::string_view mesh, std::uint32_t count, const SceneOptions& options) {
  Result<Scene> made = one_mesh_scene("randommove", mesh, count, options);
  if (!made) return made;
  Scene& scene = made.value();
  scene.description = std::to_string(count) + " bodies move at random in a cube that they fill to a fifth";
  scene.face_material = {.mu_static = 0.0F, .mu_kinetic = 0.0F, .restitution = 1.0F};
  place(scene, filled_cube(core::bounds(*scene.meshes[0]), count, FilledCube{}, scene.seed));
  return made;
}

}  // namespace broadside::datasets
