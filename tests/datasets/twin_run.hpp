// A scene run by the twin, frame by frame, and judged.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/engine/chosen_by_scene.hpp"
#include "core/engine/settings.hpp"
#include "core/trace/trace_header.hpp"
#include "reference/engines.hpp"
#include "validation/judge.hpp"

namespace broadside::tests {

struct TwinRun {
  core::TraceHeader header;
  std::vector<core::FrameRecord> frames;  // frame k is after step k + 1
};

inline TwinRun run_twin(const core::Scene& scene, const std::string& variant = "sound") {
  TwinRun run;
  const core::EngineRow row = reference::octree_cpu_row();
  const auto settings = core::Settings::parse(row.id, row.settings, {{"variant", variant}});
  EXPECT_TRUE(settings.ok()) << settings.error().line();
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok()) << engine.error().line();
  core::Dynamics& dynamics = *engine.value().dynamics;
  EXPECT_TRUE(dynamics.load(scene).ok());
  run.frames.resize(scene.frames);
  for (core::FrameRecord& frame : run.frames) {
    EXPECT_TRUE(dynamics.step(scene.dt_s).ok());
    EXPECT_TRUE(dynamics.read_back(frame, core::RecordLevel::kFull).ok());
  }
  run.header.scene = scene;
  run.header.declaration = core::declaration_of(engine.value(), scene);
  run.header.groups = dynamics.groups();
  if (const std::string note = core::digest_note_of(dynamics, scene); !note.empty()) run.header.notes["digest"] = note;
  run.header.stamp.scene_name = scene.name;
  run.header.stamp.scene_digest = core::scene_digest(scene);
  run.header.stamp.engine = std::string(row.id);
  run.header.stamp.settings = settings.value().canonical();
  run.header.stamp.settings_short = settings.value().short_form();
  return run;
}

inline std::vector<core::Verdict> verdicts_of(const core::Scene& scene, const std::string& variant = "sound") {
  const TwinRun run = run_twin(scene, variant);
  std::vector<std::uint64_t> steps;
  for (const core::FrameRecord& frame : run.frames) steps.push_back(frame.step);
  const validation::FrameSource source{run.header, steps, [&](std::uint64_t index, std::uint32_t) {
                                         return core::Result<core::FrameRecord>(run.frames[index]);
                                       }};
  auto verdicts = validation::judge(source, nullptr, {});
  EXPECT_TRUE(verdicts.ok()) << verdicts.error().line();
  return verdicts.ok() ? std::move(verdicts).value() : std::vector<core::Verdict>{};
}

}  // namespace broadside::tests
