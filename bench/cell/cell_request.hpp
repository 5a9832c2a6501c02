// One (scene, engine, settings) that somebody asked for, and where its trace goes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "bench/cell/scene_arguments.hpp"
#include "bench/cell/step_selection.hpp"
#include "core/engine/engine.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/stamp.hpp"
#include "core/trace/frame.hpp"

namespace broadside::bench {

struct CellRequest {
  SceneArguments source;  // what the scene was made from, for a child process to make the same one
  const core::Scene* scene = nullptr;
  const core::EngineRow* row = nullptr;
  GivenSettings settings;
  std::uint64_t frames = 0;
  core::RecordLevel level = core::RecordLevel::kFull;
  StepSelection selection;         // which steps are recorded
  std::uint32_t narrow_every = 1;  // narrow-phase engines measure every k-th frame of the driver
  std::filesystem::path folder;
  // For engines that do not simulate: the trace whose boxes and poses they are fed.
  std::filesystem::path driver_trace;
  bool resume = false;  // go on from what an earlier run of the same stamp left in the folder
};

core::Stamp stamp_of(const core::Scene& scene, const core::Engine& engine);

// "octree-cpu.h5", "octree-cpu+levels=A+threads=1.h5".
std::string trace_file_name(const core::Stamp& stamp);

// How many frames apart narrow-phase engines measure by default: about 30 frames of a run, spread evenly, because one
// mesh distance takes as long as a whole frame of the pipeline.
std::uint32_t default_narrow_every(std::uint64_t frames);

}  // namespace broadside::bench
