#include "datasets/scene_file/import_scene.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "core/mesh/load_mesh.hpp"
#include "core/scene/shapes.hpp"
#include "datasets/generators/scene_options.hpp"
#include "datasets/mesh/sha256.hpp"

namespace broadside::datasets {
namespace {

constexpr std::uint32_t kFrames = 600;

core::Box domain_of(const core::Scene& scene) {
  const core::ShapeTable shapes = core::build_shapes(scene);
  core::Box box = core::empty_box();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const core::Box body =
        core::translated(shapes.shapes[shapes.shape_of_body[b]].octree.boxes[0], scene.bodies[b].position);
    box = core::grown(core::grown(box, body.min), body.max);
  }
  const core::Vec3 sides = box.max - box.min;
  const float margin = std::max({sides.x, sides.y, sides.z});
  return {{box.min.x - margin, box.min.y, box.min.z - margin}, box.max + core::Vec3{margin, margin, margin}};
}

}  // namespace

core::Result<core::Scene> import_scene(const std::filesystem::path& path) {
  core::Result<core::LoadedNodes> loaded = core::load_nodes(path);
  if (!loaded) return loaded.error();
  const core::Result<std::string> sum = sha256_of_file(path);
  if (!sum) return sum.error();
  core::Scene scene;
  scene.name = path.stem().string();
  scene.description = "imported from " + path.filename().string();
  scene.frames = kFrames;
  scene.seed = kDefaultSeed;
  scene.gravity_m_s2 = kGravity;
  for (core::Mesh& mesh : loaded.value().meshes) {
    mesh.source += " sha256 " + sum.value();
    scene.meshes.push_back(std::make_shared<const core::Mesh>(std::move(mesh)));
  }
  for (const core::LoadedNode& node : loaded.value().nodes) {
    core::Body body;
    body.mesh = node.mesh;
    body.position = node.position;
    body.orientation = node.orientation;
    body.inverse_mass = node.name.ends_with("static") ? 0.0F : 1.0F;
    scene.bodies.push_back(body);
  }
  scene.domain = domain_of(scene);
  return scene;
}

}  // namespace broadside::datasets
