#include "bench/mutants/specimen_scenes.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bench/mutants/specimen_draw.hpp"
#include "datasets/scenes.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::bench {
namespace {

using core::Scene;
using core::Vec3;

std::shared_ptr<const core::Mesh> cube(int squares) {
  // Sides and squares are literals in this file; a wrong one ends the program in value().
  return std::make_shared<const core::Mesh>(
      std::move(datasets::box_mesh({1.0, 1.0, 1.0}, {squares, squares, squares})).value());
}

core::Body body_at(Vec3 x, Vec3 v, float mass_kg) {
  core::Body body;
  body.position = x;
  body.velocity = v;
  body.inverse_mass = mass_kg > 0.0F ? 1.0F / mass_kg : 0.0F;
  return body;
}

Scene around_origin(std::string_view name, std::uint32_t frames) {
  Scene scene;
  scene.name = name;
  scene.meshes = {cube(8)};
  scene.domain = {{-4, -4, -4}, {4, 4, 4}};
  scene.frames = frames;
  return scene;
}

// Exact overlaps of 1/2, 1/4 and 1/4 m.
Scene ties() {
  Scene scene = around_origin("ties", 2);
  scene.bodies = {body_at({0, 0, 0}, {}, 1.0F), body_at({0.5F, 0.75F, 0.75F}, {}, 1.0F)};
  return scene;
}

// Overlaps of 33/128 m on x and 1/4 m on y: 3 % apart.
Scene fudge() {
  Scene scene = around_origin("fudge", 2);
  scene.bodies = {body_at({0, 0, 0}, {}, 1.0F), body_at({0.7421875F, 0.75F, 0}, {}, 1.0F)};
  return scene;
}

// Faces in one plane, to the bit.
Scene touching() {
  Scene scene = around_origin("touching", 2);
  scene.bodies = {body_at({0, 0, 0}, {}, 1.0F), body_at({1, 0.25F, 0}, {}, 1.0F)};
  return scene;
}

// Three boxes along a diagonal that meet corner to corner: only the first and the last leaves meet.
Scene corner() {
  Scene scene = around_origin("corner", 30);
  scene.bodies = {body_at({-1.0F, -1.0F, -1.0F}, {1, 1, 1}, 1.0F), body_at({0.0F, 0.0F, 0.0F}, {}, 1.0F),
                  body_at({1.0F, 1.0F, 1.0F}, {-1, -1, -1}, 1.0F)};
  return scene;
}

// Balls that pass each other diagonally: boxes of high levels meet long before those of low ones, and vertices last.
Scene balls() {
  Scene scene = around_origin("balls", 90);
  scene.meshes = {std::make_shared<const core::Mesh>(std::move(datasets::sphere_mesh(0.5, 6)).value())};
  scene.parameters.theta_m = 0.05F;
  for (int k = 0; k < 4; ++k) {
    const float z = -3.0F + 2.0F * static_cast<float>(k);
    const float off = 0.1F * static_cast<float>(k);
    scene.bodies.push_back(body_at({-1.0F, -0.875F + off, z}, {1.0F, 0.875F, 0.0F}, 1.0F));
    scene.bodies.push_back(body_at({0.625F, 0.125F, z + 0.25F}, {-0.25F, 0.0F, 0.0F}, 1.0F));
  }
  return scene;
}

// Bodies that approach below the scene's threshold speed, and above it once lengths are twice as large.
Scene slow() {
  Scene scene = around_origin("two-body:slow", 120);
  scene.bodies = {body_at({-0.6F, 0, 0}, {0.1F, 0, 0}, 1.0F), body_at({0.6F, 0, 0}, {-0.1F, 0, 0}, 1.0F)};
  return scene;
}

// Two surfaces with unlike properties meet.
Scene materials() {
  Scene scene = around_origin("materials", 60);
  scene.bodies = {body_at({-0.75F, 0, 0}, {1, 0.5F, 0}, 1.0F), body_at({0.75F, 0.25F, 0.125F}, {-1, 0, 0}, 2.0F)};
  scene.bodies[0].material = {0.9F, 0.8F, 0.9F};
  scene.bodies[1].material = {0.2F, 0.1F, 0.1F};
  return scene;
}

// Bodies that fly out through faces of the domain, without any force.
Scene leaving() {
  Scene scene = around_origin("leaving", 60);
  scene.bodies = {body_at({3.0F, 0, 0}, {2, 0, 0}, 1.0F), body_at({-3.0F, 0, 0}, {-2, 0, 0}, 1.0F)};
  return scene;
}

// The random scene with much friction, a floor that lifts impulses often, and two static bodies inside each other.
Scene pile() {
  Scene scene = random_scene(11, -2.0F, 10.0F);
  scene.name = "pile";
  scene.frames = 60;
  scene.parameters.impulse_min_n_s = 0.3F;
  scene.parameters.delta_m = 0.001F;
  for (core::Body& b : scene.bodies) b.material.mu_static += 0.2F;
  scene.bodies[5] = body_at({0.5F, -1.5F, 0.25F}, {}, 0.0F);
  scene.bodies[11] = body_at({-0.25F, -1.25F, 0.25F}, {}, 0.0F);
  return scene;
}

Scene fast() {
  Scene scene = random_scene(12, -2.0F, 10.0F);
  scene.name = "fast";
  scene.parameters.v_max_m_s = 2.0F;
  return scene;
}

struct SpecimenRow {
  std::string_view name;
  Scene (*make)();
};
constexpr std::array kSpecimenScenes{
    SpecimenRow{"mixed", [] { return mixed_scene(cube(4)); }},
    SpecimenRow{"ties", ties},
    SpecimenRow{"fudge", fudge},
    SpecimenRow{"touching", touching},
    SpecimenRow{"corner", corner},
    SpecimenRow{"balls", balls},
    SpecimenRow{"two-body:slow", slow},
    SpecimenRow{"materials", materials},
    SpecimenRow{"leaving", leaving},
    SpecimenRow{"pile", pile},
    SpecimenRow{"fast", fast},
};

}  // namespace

Scene mixed_scene(std::shared_ptr<const core::Mesh> mesh) {
  Scene scene;
  scene.name = "mixed";
  scene.meshes = {std::move(mesh)};
  scene.domain = {{0, 0, 0}, {10, 10, 10}};
  scene.gravity_m_s2 = {0, -9.81F, 0};
  scene.frames = 45;
  scene.parameters.delta_m = 0.01F;
  scene.parameters.beta = 0.6F;
  scene.parameters.alpha = 0.9F;
  scene.bodies = {
      body_at({3.0F, 5.0F, 5.0F}, {4.0F, 0.5F, 0.3F}, 2.0F), body_at({4.3F, 5.1F, 5.2F}, {-2.0F, 0.0F, -0.2F}, 0.5F),
      body_at({7.0F, 0.49F, 3.0F}, {0, 0, 0}, 0.0F),         body_at({7.2F, 1.75F, 3.1F}, {0.4F, -1.0F, 0.2F}, 1.0F),
      body_at({8.6F, 0.6F, 7.0F}, {3.0F, 0.0F, 0.7F}, 1.5F), body_at({1.0F, 9.0F, 1.0F}, {0.0F, 0.0F, 0.0F}, 1.0F),
  };
  return scene;
}

Scene random_scene(std::uint32_t seed, float origin_m, float largest_mass_ratio) {
  Draw draw(seed);
  Scene scene;
  scene.name = "random:" + std::to_string(seed);
  scene.meshes = {cube(4)};
  const Vec3 low{origin_m, origin_m, origin_m};
  scene.domain = {low, low + Vec3{4, 4, 4}};
  scene.gravity_m_s2 = {draw.uniform(-2, 2), draw.uniform(-10, 0), draw.uniform(-2, 2)};
  scene.dt_s = draw.uniform(0.002F, 0.02F);
  scene.frames = 60;
  scene.seed = seed;
  core::Parameters& p = scene.parameters;
  p.beta = draw.uniform(0.3F, 1.0F);
  p.alpha = draw.uniform(0.3F, 1.0F);
  p.delta_m = draw.uniform(0.0F, 0.02F);
  p.impulse_min_n_s = draw.uniform(0.0F, 0.1F);
  p.v_threshold_m_s = draw.uniform(0.0F, 1.0F);
  p.v_max_m_s = draw.uniform(2.0F, 20.0F);
  const auto material = [&draw] {
    const float mu = draw.uniform(0.0F, 1.0F);
    const float share = draw.uniform(0.0F, 1.0F);
    return core::Material{mu, mu * share, draw.uniform(0.0F, 1.0F)};
  };
  const auto vec3 = [&draw](float least, float most) {
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = draw.uniform(least, most);
    return v;
  };
  scene.face_material = material();
  for (int k = 0; k < 12; ++k) {
    const Vec3 place = low + vec3(0.6F, 3.4F);
    const Vec3 velocity = vec3(-5, 5);
    const float mass_kg = std::exp(draw.uniform(0.0F, std::log(largest_mass_ratio)));
    core::Body body = k % 6 == 5 ? body_at(place, {}, 0.0F) : body_at(place, velocity, mass_kg);
    body.material = material();
    scene.bodies.push_back(body);
  }
  return scene;
}

core::Result<Scene> specimen_scene(std::string_view name) {
  for (const SpecimenRow& row : kSpecimenScenes)
    if (row.name == name) return row.make();
  return datasets::make_scene(std::string(name));
}

}  // namespace broadside::bench
