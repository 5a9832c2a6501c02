// Scenes for the GPU's tests, made from formulas so that they need no files.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/pair.hpp"
#include "core/scene/scene.hpp"

namespace broadside::gpu {

// Deterministic numbers in [0, 1): the fractional parts of multiples of an irrational number, scrambled.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  float next() {
    state_ = core::splitmix64(state_);
    return static_cast<float>(state_ >> 40U) * 0x1p-24F;
  }
  core::Vec3 cube(float side) { return {side * (next() - 0.5F), side * (next() - 0.5F), side * (next() - 0.5F)}; }

 private:
  std::uint64_t state_;
};

// A sphere with bumps: `rings` rings of 2 `rings` vertices. No symmetry, so that no two distances are equal.
inline std::shared_ptr<core::Mesh> bumpy_sphere(std::uint32_t rings, float radius) {
  auto mesh = std::make_shared<core::Mesh>();
  mesh->name = "bumpy-sphere";
  const std::uint32_t segments = 2 * rings;
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t s = 0; s < segments; ++s) {
      const double polar = 3.14159265358979 * (r + 0.5) / rings;
      const double around = 6.28318530717959 * (s + 0.37 * r) / segments;
      const double bump = radius * (1.0 + 0.15 * std::sin(3.0 * around + 1.0) * std::sin(5.0 * polar));
      mesh->vertices.push_back({static_cast<float>(bump * std::sin(polar) * std::cos(around)),
                                static_cast<float>(bump * std::cos(polar)),
                                static_cast<float>(bump * std::sin(polar) * std::sin(around))});
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t s = 0; s < segments; ++s) {
      const std::uint32_t p = r * segments + s;
      const std::uint32_t q = r * segments + (s + 1) % segments;
      mesh->triangles.push_back({p, q, p + segments});
      mesh->triangles.push_back({q, q + segments, p + segments});
    }
  }
  return mesh;
}

inline std::shared_ptr<core::Mesh> box_mesh(core::Vec3 half) {
  auto mesh = std::make_shared<core::Mesh>();
  mesh->name = "box";
  for (int k = 0; k < 8; ++k)
    mesh->vertices.push_back(
        {(k & 1) != 0 ? half.x : -half.x, (k & 2) != 0 ? half.y : -half.y, (k & 4) != 0 ? half.z : -half.z});
  mesh->triangles = {{0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}, {0, 4, 1}, {1, 4, 5},
                     {2, 3, 6}, {3, 7, 6}, {0, 2, 4}, {2, 6, 4}, {1, 5, 3}, {3, 5, 7}};
  return mesh;
}

struct SceneShape {
  std::uint32_t bodies = 60;
  float cube_m = 4.0F;  // side of the cube in which bodies start
  float speed_m_s = 4.0F;
  float gravity_m_s2 = 9.81F;
  std::uint32_t static_every = 0;  // every so many bodies one is static; 0 = none
  std::uint64_t seed = 1;
};

inline core::Scene thrown(std::vector<std::shared_ptr<const core::Mesh>> meshes, const SceneShape& shape) {
  core::Scene scene;
  scene.name = "thrown";
  scene.meshes = std::move(meshes);
  Dice dice(shape.seed);
  for (std::uint32_t i = 0; i < shape.bodies; ++i) {
    core::Body body;
    body.mesh = i % static_cast<std::uint32_t>(scene.meshes.size());
    body.position = dice.cube(shape.cube_m);
    body.velocity = dice.cube(2.0F * shape.speed_m_s);
    body.inverse_mass = 0.25F + 2.0F * dice.next();
    if (shape.static_every != 0 && i % shape.static_every == 0) body.inverse_mass = 0.0F, body.velocity = {};
    body.material.restitution = dice.next();
    if (i % 3 == 0) body.orientation = {0.8F, 0.6F, 0.0F, 0.0F};
    scene.bodies.push_back(body);
  }
  const float half = 0.5F * shape.cube_m + 0.3F;
  scene.domain = {{-half, -half, -half}, {half, half, half}};
  scene.gravity_m_s2 = {0, -shape.gravity_m_s2, 0};
  return scene;
}

// Bumpy spheres of two kinds, of so many rings each.
inline core::Scene thrown_spheres(std::uint32_t rings, std::uint32_t other_rings, std::uint32_t bodies, float cube_m,
                                  std::uint32_t static_every) {
  SceneShape shape;
  shape.bodies = bodies;
  shape.cube_m = cube_m;
  shape.static_every = static_every;
  return thrown({bumpy_sphere(rings, 0.5F), bumpy_sphere(other_rings, 0.6F)}, shape);
}

// Of few vertices, for the kernels' threads on the host.
inline core::Scene coarse_spheres(std::uint32_t bodies, float cube_m, std::uint32_t static_every = 0) {
  return thrown_spheres(4, 3, bodies, cube_m, static_every);
}

// On the first bodies, one or two each; some bodies stay free.
inline void add_springs(core::Scene& scene, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k)
    scene.springs.push_back(
        {k * 7 % (2 * count / 3), {0.1F * static_cast<float>(k), 1.0F, -0.5F}, 20.0F + static_cast<float>(k), 0.4F});
}

}  // namespace broadside::gpu
