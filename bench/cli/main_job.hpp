// The main job: one scene on every engine, judged, timed and reported.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/cell/scene_arguments.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

struct MainJob {
  SceneArguments scene{"freefall:bunny:50", 0, true};
  std::uint32_t repetitions = 2;
  std::filesystem::path folder = "out/demo";
};

// Leaves one trace per engine, cells.json, verdicts.json, samples.json, report.html, report.md and junit.xml in the
// folder. Results of the same build and scene that are there already are reused.
core::Result<core::RunRows> run_main_job(const MainJob& job);

// 1 when a verdict failed, 3 when one is inconclusive or a cell is missing that this machine could have run, else 0.
core::Exit exit_of(const core::RunRows& rows);

}  // namespace broadside::bench
