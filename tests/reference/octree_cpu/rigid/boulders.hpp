// Round, finely cut hulls, and a shaft in which they come to rest on each other.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "core/exact/convex_hull.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"
#include "core/scene/scene.hpp"
#include "datasets/scenes.hpp"

namespace broadside::tests {

// The hull of 40 points at half a meter from the origin.
inline std::shared_ptr<const core::Mesh> boulder() {
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  std::vector<core::Vec3> points;
  for (int k = 0; k < 40; ++k) {
    const core::Vec3 p{normal(random), normal(random), normal(random)};
    points.push_back((0.5F / core::length(p)) * p);
  }
  core::Mesh mesh = *exact::convex_hull(points);
  mesh.name = "boulder";
  return std::make_shared<const core::Mesh>(std::move(mesh));
}

inline core::Scene five_boulders() {
  auto scene = datasets::make_scene("freefall:cube:5[rigid=1]", {});
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  const auto mesh = boulder();
  for (auto& each : scene.value().meshes) each = mesh;
  return std::move(scene).value();
}

// Boulders on top of each other, in a shaft hardly wider than they are.
inline core::Scene five_boulders_in_a_shaft() {
  core::Scene scene = five_boulders();
  scene.domain = {{-0.6F, 0.0F, -0.6F}, {0.6F, 8.0F, 0.6F}};
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    scene.bodies[k].position = {(k & 1U) != 0 ? 0.05F : -0.05F, 0.55F + 1.02F * static_cast<float>(k), 0.0F};
  return scene;
}

}  // namespace broadside::tests
