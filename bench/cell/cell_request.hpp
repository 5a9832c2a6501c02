// A request for one cell (scene, engine, settings), and where its trace goes.
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
  SceneArguments source;  // how the scene was made, so that a child process can make the same one
  const core::Scene* scene = nullptr;
  const core::EngineRow* row = nullptr;
  GivenSettings settings;
  std::uint64_t frames = 0;
  core::RecordLevel level = core::RecordLevel::kFull;
  StepSelection selection;         // which steps are recorded
  std::uint32_t narrow_every = 1;  // narrow-phase engines measure every k-th frame of the driver
  std::filesystem::path folder;
  // For engines that do not simulate: the trace from which they get boxes and poses.
  std::filesystem::path driver_trace;
  bool resume = false;  // go on from what an earlier run of the same stamp left in the folder
};

core::Stamp stamp_of(const core::Scene& scene, const core::Engine& engine);

// "octree-cpu.h5", "octree-cpu+levels=A+threads=1.h5".
std::string trace_file_name(const core::Stamp& stamp);

// Narrow-phase engines measure every k-th frame, so that a run has about 30 measured frames, spread evenly: one mesh
// distance takes as long as a whole frame of the pipeline.
std::uint32_t default_narrow_every(std::uint64_t frames);

}  // namespace broadside::bench
