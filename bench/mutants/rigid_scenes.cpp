#include "bench/mutants/rigid_scenes.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/mutants/specimen_draw.hpp"
#include "core/nearest_name.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::bench {
namespace {

using core::Body;
using core::Scene;
using core::Vec3;

std::shared_ptr<const core::Mesh> box(double x, double y, double z) {
  // Sides are literals or drawn above zero; a wrong one ends the program in value().
  return std::make_shared<const core::Mesh>(std::move(datasets::box_mesh({x, y, z}, {1, 1, 1})).value());
}

std::shared_ptr<const core::Mesh> ball(double radius) {
  return std::make_shared<const core::Mesh>(std::move(datasets::sphere_mesh(radius, 6)).value());
}

Scene world(std::string_view name, std::uint32_t frames, float dt_s) {
  Scene scene;
  scene.name = name;
  scene.domain = {{-10, 0, -10}, {10, 20, 10}};
  scene.gravity_m_s2 = {0, -9.81F, 0};
  scene.dt_s = dt_s;
  scene.frames = frames;
  scene.motion = core::Motion::kRigid;
  return scene;
}

Body& add(Scene& scene, std::uint32_t mesh, Vec3 x, Vec3 v, float mass_kg, Vec3 spin = {}) {
  Body body;
  body.mesh = mesh;
  body.position = x;
  body.velocity = v;
  body.angular_velocity = spin;
  body.inverse_mass = mass_kg > 0.0F ? 1.0F / mass_kg : 0.0F;
  return scene.bodies.emplace_back(body);
}

Scene mixed() {
  Scene scene = world("rigid-mixed", 60, 1.0F / 120.0F);
  scene.meshes = {box(0.1, 0.4, 0.9), box(0.5, 0.5, 0.5), ball(0.25), box(2.0, 0.5, 2.0)};
  add(scene, 0, {-5, 12, 0}, {1, 2, 0}, 10.0F, {0.5F, 3.0F, 0.4F});
  add(scene, 0, {5, 14, 0}, {0, 1, 1}, 3.0F, {2.0F, 1.0F, 2.0F});
  add(scene, 1, {-4, 0.25F, -4}, {3, 0, 2}, 2.0F);
  add(scene, 2, {0, 0.75F, -6}, {1, -2, 0}, 1.0F, {0, 0, 4});
  add(scene, 1, {-1.0F, 6, 4}, {3, 1, 0}, 1.0F, {0, 0.5F, 0});
  add(scene, 1, {0.2F, 6.2F, 4.1F}, {-2, 1, 0}, 4.0F, {0.25F, 0, 0.5F});
  add(scene, 1, {5, 0.25F, 5}, {}, 1.0F);
  add(scene, 1, {5.1F, 0.75F, 5}, {}, 1.0F);
  add(scene, 3, {-6, 0.25F, 6}, {}, 0.0F);
  add(scene, 2, {-6.2F, 1.0F, 6}, {0.5F, -1, 0}, 1.0F);
  return scene;
}

Scene stack() {
  Scene scene = world("rigid-stack", 240, 1.0F / 60.0F);
  scene.meshes = {box(1, 1, 1)};
  for (int k = 0; k < 3; ++k) add(scene, 0, {0, 0.5F + static_cast<float>(k), 0}, {}, 1.0F);
  scene.answer = "stands";
  return scene;
}

// A pile that sleeps before something falls on it.
Scene nap() {
  Scene scene = world("rigid-nap", 180, 1.0F / 60.0F);
  scene.meshes = {box(1, 1, 1), ball(0.25)};
  for (int k = 0; k < 3; ++k) add(scene, 0, {0, 0.5F + static_cast<float>(k), 0}, {}, 1.0F);
  add(scene, 1, {0, 18, 0}, {}, 1.0F);
  return scene;
}

Scene overlap() {
  Scene scene = world("rigid-overlap", 60, 1.0F / 240.0F);
  scene.meshes = {box(1, 1, 1)};
  add(scene, 0, {0, 0.45F, 0}, {}, 1.0F);
  add(scene, 0, {0, 1.40F, 0}, {}, 1.0F);
  return scene;
}

Scene offset() {
  Scene scene = world("rigid-offset", 60, 1.0F / 60.0F);
  scene.meshes = {box(1, 1, 1)};
  add(scene, 0, {0, 0.5F, 0}, {}, 0.0F);
  add(scene, 0, {0.4F, 1.55F, 0.2F}, {0, -1, 0}, 1.0F);
  return scene;
}

Scene fast_bodies() {
  Scene scene = world("rigid-fast", 20, 1.0F / 60.0F);
  scene.meshes = {ball(0.1), box(0.1, 4, 4)};
  add(scene, 0, {-4.5F, 4, 0}, {300, 0, 0}, 1.0F);
  add(scene, 1, {0, 4, 0}, {}, 0.0F);
  return scene;
}

// A blade that turns by 72 degrees a step, through a post.
Scene blade() {
  Scene scene = world("rigid-blade", 12, 1.0F / 60.0F);
  scene.meshes = {box(2.0, 0.2, 0.2), box(0.2, 4, 0.2)};
  scene.gravity_m_s2 = {};
  add(scene, 0, {0, 8, 0}, {}, 1.0F, {0, 75.0F, 0});
  add(scene, 1, {0.55F, 8, -0.44F}, {}, 0.0F);
  return scene;
}

Scene million() {
  Scene scene = world("rigid-million", 20, 1.0F / 60.0F);
  scene.meshes = {box(0.5, 0.5, 0.5)};
  add(scene, 0, {0, 10, 0}, {}, 1.0F, {0, 1e6F, 0});
  return scene;
}

Scene bounce() {
  Scene scene = world("rigid-bounce", 240, 1.0F / 240.0F);
  scene.meshes = {ball(0.25)};
  add(scene, 0, {0, 1.25F, 0}, {}, 1.0F);
  scene.bodies[0].material.restitution = scene.face_material.restitution = 0.8F;
  scene.answer = "bounce";
  return scene;
}

Scene flight() {
  Scene scene = world("rigid-flight", 60, 1.0F / 60.0F);
  scene.meshes = {box(0.5, 0.5, 0.5)};
  add(scene, 0, {-2, 8, 0}, {2, 1, 0}, 1.0F);
  scene.answer = "flight";
  return scene;
}

Scene slide() {
  Scene scene = world("rigid-slide", 200, 1.0F / 240.0F);
  scene.meshes = {box(1, 0.25, 1)};
  add(scene, 0, {0, 0.125F, 0}, {3, 0, 2}, 1.0F);
  scene.answer = "slide";
  return scene;
}

Scene spin_up() {
  Scene scene = world("rigid-spin-up", 60, 1.0F / 60.0F);
  scene.meshes = {box(0.5, 0.5, 0.5)};
  scene.gravity_m_s2 = {};
  add(scene, 0, {0, 8, 0}, {}, 1.0F);
  scene.wrenches = {{0, core::WrenchAxes::kBody, {}, {0, 0.125F, 0}}};
  scene.answer = "spin-up";
  return scene;
}

struct RigidSceneRow {
  std::string_view name;
  Scene (*make)();
};
constexpr std::array kRigidScenes{RigidSceneRow{"rigid-mixed", mixed},      RigidSceneRow{"rigid-stack", stack},
                                  RigidSceneRow{"rigid-overlap", overlap},  RigidSceneRow{"rigid-offset", offset},
                                  RigidSceneRow{"rigid-fast", fast_bodies}, RigidSceneRow{"rigid-blade", blade},
                                  RigidSceneRow{"rigid-million", million},  RigidSceneRow{"rigid-bounce", bounce},
                                  RigidSceneRow{"rigid-flight", flight},    RigidSceneRow{"rigid-slide", slide},
                                  RigidSceneRow{"rigid-spin-up", spin_up},  RigidSceneRow{"rigid-nap", nap}};

}  // namespace

core::Result<Scene> rigid_scene(std::string_view name) {
  std::vector<std::string_view> names;
  for (const RigidSceneRow& row : kRigidScenes) {
    if (row.name == name) return row.make();
    names.push_back(row.name);
  }
  return core::Error{"unknown scene '" + std::string(name) + "'", "", core::advise_name(name, names)};
}

Scene random_rigid_scene(std::uint32_t seed, float dt_s, std::uint32_t frames) {
  Draw draw(seed);
  Scene scene = world("random-rigid:" + std::to_string(seed), frames, dt_s);
  scene.domain = {{-2, 0, -2}, {2, 4, 2}};
  scene.seed = seed;
  const auto vec3 = [&draw](float least, float most) {
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = draw.uniform(least, most);
    return v;
  };
  const auto material = [&draw] {
    const float mu = draw.uniform(0.0F, 1.0F);
    return core::Material{mu, mu * draw.uniform(0.5F, 1.0F), draw.uniform(0.0F, 0.8F)};
  };
  scene.face_material = material();
  // One body to a cell of a lattice, so that none starts inside another.
  std::uint32_t mesh = 0;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) {
        if (draw.uniform(0.0F, 1.0F) < 0.5F) continue;
        const bool is_ball = draw.uniform(0.0F, 1.0F) < 0.4F;
        const Vec3 sides = vec3(0.15F, 0.65F);
        scene.meshes.push_back(is_ball ? ball(0.5F * sides.x) : box(sides.x, sides.y, sides.z));
        const Vec3 cell{-1.2F + 1.2F * static_cast<float>(x), 0.65F + 1.2F * static_cast<float>(y),
                        -1.2F + 1.2F * static_cast<float>(z)};
        const float mass_kg = draw.uniform(0.0F, 1.0F) < 0.1F ? 0.0F : std::exp(draw.uniform(-1.0F, 1.0F));
        Body& body = add(scene, mesh++, cell, mass_kg > 0.0F ? vec3(-3, 3) : Vec3{}, mass_kg,
                         mass_kg > 0.0F ? vec3(-4, 4) : Vec3{});
        body.material = material();
      }
  if (scene.bodies.empty()) {
    scene.meshes.push_back(ball(0.3));
    add(scene, 0, {0, 2, 0}, {1, 0, 0}, 1.0F);
  }
  return scene;
}

}  // namespace broadside::bench
