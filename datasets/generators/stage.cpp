#include "datasets/generators/stage.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "datasets/generators/scene_options.hpp"
#include "datasets/shapes/box_mesh.hpp"

namespace broadside::datasets {
namespace {

core::Vec3 rounded(const Triple& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

constexpr double kCutsOfModel = 8.0;
constexpr double kMostCuts = 64.0;  // of a long side; the mesh stays small

}  // namespace

Stage::Stage(const GivenScene& given) {
  scene_.meshes.push_back(given.model);
  scene_.gravity_m_s2 = kGravity;
  const core::Box box = core::bounds(*given.model);
  for (int k = 0; k < 3; ++k) sides_[k] = double{box.max[k]} - double{box.min[k]};
  longest_ = std::max({sides_[0], sides_[1], sides_[2]});
}

std::uint32_t Stage::add_mesh(std::shared_ptr<const core::Mesh> mesh) {
  scene_.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
}

void Stage::add_body(const Triple& center, const Triple& velocity, double mass_kg, std::uint32_t mesh) {
  const core::Box box = core::bounds(*scene_.meshes[mesh]);
  Triple position;
  for (int k = 0; k < 3; ++k) position[k] = center[k] - 0.5 * (double{box.min[k]} + double{box.max[k]});
  core::Body body;
  body.mesh = mesh;
  body.position = rounded(position);
  body.velocity = rounded(velocity);
  body.inverse_mass = mass_kg > 0.0 ? static_cast<float>(1.0 / mass_kg) : 0.0F;
  scene_.bodies.push_back(body);
}

void Stage::add_static_box(const Triple& low, const Triple& high) {
  Triple sides;
  Triple center;
  std::array<int, 3> segments;
  const double cut = longest_ / kCutsOfModel;
  for (int k = 0; k < 3; ++k) {
    // Rounded to float, so that equal boxes at different places have equal sides.
    sides[k] = double{static_cast<float>(high[k] - low[k])};
    center[k] = 0.5 * (low[k] + high[k]);
    segments[k] = static_cast<int>(std::clamp(std::ceil(sides[k] / cut - 1e-6), 1.0, kMostCuts));
  }
  const auto [entry, is_new] = box_meshes_.try_emplace(sides, 0U);
  if (is_new) {
    // The sides are positive here; an invalid one ends the program in value().
    core::Mesh mesh = std::move(box_mesh(sides, segments)).value();
    mesh.name = "part" + std::to_string(box_meshes_.size());
    scene_.parameters.theta_m =
        std::max({scene_.parameters.theta_m, core::mean_edge_m(mesh), core::mean_edge_m(*scene_.meshes[0])});
    entry->second = add_mesh(std::make_shared<const core::Mesh>(std::move(mesh)));
  }
  add_body(center, {}, 0.0, entry->second);
}

core::Scene Stage::finish(const Triple& low, const Triple& high) && {
  scene_.domain = {rounded(low), rounded(high)};
  return std::move(scene_);
}

}  // namespace broadside::datasets
