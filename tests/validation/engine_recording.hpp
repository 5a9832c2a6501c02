// Records the CPU twin in memory, as the program records it to a file.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "core/engine/engine.hpp"
#include "core/engine/settings.hpp"
#include "core/scene/scene.hpp"
#include "datasets/scenes.hpp"
#include "reference/engines.hpp"
#include "reference/octree_cpu/pipeline.hpp"
#include "reference/scene_octree/broad_phases.hpp"
#include "tests/validation/sound_world.hpp"

namespace broadside::tests {

using EngineSettings = std::map<std::string, std::string>;

inline core::Scene named_scene(const std::string& name) {
  auto scene = datasets::make_scene(name);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  return scene.ok() ? std::move(scene).value() : core::Scene{};
}

inline Recording record_frames(const core::Scene& scene, core::Dynamics& dynamics, const std::string& settings) {
  auto recorded = bench::record_specimen(scene, dynamics, settings);
  EXPECT_TRUE(recorded.ok()) << (recorded.ok() ? "" : recorded.error().line());
  return recorded.ok() ? std::move(recorded).value() : Recording{};
}

// The engine as users get it.
inline Recording record(const core::Scene& scene, const EngineSettings& given) {
  const core::EngineRow row = reference::octree_cpu_row();
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok()) << (settings.ok() ? "" : settings.error().line());
  auto created = row.create(settings.value());
  EXPECT_TRUE(created.ok());
  core::Engine engine = std::move(created).value();
  return record_frames(scene, *engine.dynamics, engine.settings.canonical());
}

// The pipeline behind P-Alg 1 and 2's scene octree, whose printed form is E2.
inline Recording record_scene_octree(const core::Scene& scene, core::Variant variant, const std::string& name) {
  reference::PipelineOptions options;
  options.variant = variant;
  options.threads = 1;
  options.make_broad_phase = [variant](const core::Scene& s) {
    return reference::make_scene_octree_broad_phase(s.domain, core::kSceneOctreeDepth, variant);
  };
  reference::Pipeline pipeline(std::move(options));
  return record_frames(scene, pipeline,
                       "broad=octree,levels=C,solver=colored,threads=1,variant=" + name + ",vertex_stage=on");
}

}  // namespace broadside::tests
