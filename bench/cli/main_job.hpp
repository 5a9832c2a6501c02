// The main job: two scenes on every engine, judged, timed and reported. In the first scene bodies translate, and broad
// phases, narrow phases and the pipeline are compared. In the second scene bodies turn, and engines of rigid bodies are
// compared.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/cell/scene_arguments.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

struct MainJob {
  SceneArguments scene{"freefall:bunny:50", 0, true};
  // Bricks, because a cube's inertia hides whether an engine knows the gyroscopic torque.
  SceneArguments turning{"freefall:brick:12[rigid=1,frames=240]", 0, true};
  std::uint32_t repetitions = 2;
  std::filesystem::path folder = "out/demo";
};

struct MainJobRows {
  core::RunRows all;  // the first scene's, then the turning scene's; file names are relative to the job's folder
  // All rows except those of the turning scene's engines that others made: these rows decide the exit code.
  core::RunRows deciding;
  core::RunRows others;  // the rest
};

// Leaves report.html, report.md and junit.xml (the deciding rows) in the folder, with the first scene's traces and
// rows. Those of the turning scene are in the folder "turning" below it. Existing results of the same build and scene
// are reused.
core::Result<MainJobRows> run_main_job(const MainJob& job);

// 1 when a deciding verdict failed, 3 when one is inconclusive or a cell is missing that this machine could have run,
// else 0.
core::Exit exit_of(const MainJobRows& rows);

}  // namespace broadside::bench
