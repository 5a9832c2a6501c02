// Scenes of boxes and balls for the turning pipeline, and what it makes of them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/method/rigid/rigid_settings.hpp"
#include "core/scene/scene.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "reference/octree_cpu/rigid/rigid_declaration.hpp"
#include "reference/octree_cpu/rigid/rigid_pipeline.hpp"
#include "reference/scene_octree/broad_phases.hpp"

namespace broadside::tests {

struct PipelineRig {
  core::Scene scene;
  reference::RigidPipelineOptions options;

  PipelineRig() {
    scene.motion = core::Motion::kRigid;
    scene.gravity_m_s2 = {0.0F, -9.81F, 0.0F};
    scene.domain = {{-50, 0, -50}, {50, 100, 50}};
    options.make_broad_phase = [](const core::Scene&) { return reference::make_tree_broad_phase(); };
    options.make_solver = [](const core::Scene&) { return reference::make_contact_solver({}); };
    options.declare = [](const core::Scene& of) { return reference::rigid_declaration({}, of); };
  }

  std::uint32_t box(double x, double y, double z) {
    scene.meshes.push_back(
        std::make_shared<const core::Mesh>(std::move(datasets::box_mesh({x, y, z}, {1, 1, 1})).value()));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
  }
  std::uint32_t ball(double radius_m) {
    scene.meshes.push_back(std::make_shared<const core::Mesh>(std::move(datasets::sphere_mesh(radius_m, 6)).value()));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
  }
  // mass_kg: 0 = static.
  core::Body& add(std::uint32_t mesh, core::Vec3 x, float mass_kg, core::Vec3 v = {}, core::Vec3 spin = {}) {
    core::Body body;
    body.mesh = mesh;
    body.position = x;
    body.velocity = v;
    body.angular_velocity = spin;
    body.inverse_mass = mass_kg > 0.0F ? 1.0F / mass_kg : 0.0F;
    return scene.bodies.emplace_back(body);
  }

  [[nodiscard]] std::vector<core::FrameRecord> run(std::uint32_t steps) const {
    reference::RigidPipeline engine(options);
    const core::Status loaded = engine.load(scene);
    EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().line());
    std::vector<core::FrameRecord> frames(steps);
    for (core::FrameRecord& frame : frames) {
      const core::Status stepped = engine.step(scene.dt_s);
      EXPECT_TRUE(stepped.ok()) << (stepped.ok() ? "" : stepped.error().line());
      EXPECT_TRUE(engine.read_back(frame, core::RecordLevel::kFull).ok());
    }
    return frames;
  }
};

}  // namespace broadside::tests
