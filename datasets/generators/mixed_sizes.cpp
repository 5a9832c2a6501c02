#include <array>
#include <memory>
#include <string>
#include <utility>

#include "core/mesh/clean_mesh.hpp"
#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/scene_options.hpp"
#include "datasets/generators/stage.hpp"
#include "datasets/generators/start_grid.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kMixedSizesKnobs[] = {
    {"smallest", 0.25, 0.01, 1.0, "smallest size, as a share of the longest side"},
    {"largest", 2.0, 1.0, 100.0,
     "largest size, as a share of the longest side; each size is less frequent than the next smaller one"},
};

constexpr std::uint32_t kSizes = 8;

core::Scene mixed_sizes(const GivenScene& given) {
  core::Scene scene;
  scene.gravity_m_s2 = kGravity;
  Stage stage(given);
  std::array<double, kSizes> sizes{};
  for (std::uint32_t k = 0; k < kSizes; ++k) {
    const double t = static_cast<double>(k) / (kSizes - 1);
    sizes[k] = given.knobs[0] + (given.knobs[1] - given.knobs[0]) * t * t;
    core::Mesh mesh = core::normalized(*given.model, sizes[k] * stage.longest());
    mesh.name += "_size" + std::to_string(k);
    scene.meshes.push_back(std::make_shared<const core::Mesh>(std::move(mesh)));
  }
  place(scene, stacked_grid(core::bounds(*scene.meshes.back()), given.count, StackedGrid{}, given.seed));
  RandomStream random(core::splitmix64(given.seed));
  for (core::Body& body : scene.bodies) {
    const double u = random.unit();
    body.mesh = static_cast<std::uint32_t>(u * u * kSizes);
    // A body of the requested size has 1 kg.
    body.inverse_mass = static_cast<float>(1.0 / (sizes[body.mesh] * sizes[body.mesh] * sizes[body.mesh]));
  }
  return scene;
}

}  // namespace

SceneFamily mixed_sizes_family() {
  return {"mixed-sizes",
          "mixed-sizes:MESH:N",
          "mixed-sizes:cube:60",
          "free fall of one model in eight sizes, of one density",
          600,
          kMixedSizesKnobs,
          mixed_sizes};
}

}  // namespace broadside::datasets
