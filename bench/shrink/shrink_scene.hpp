// Makes a scene in which an engine gets a verdict as small as possible while the verdict stays.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bench/shrink/trial.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/verdict.hpp"

namespace broadside::bench {

struct ShrinkLimits {
  double time_s = 60.0;
  // Called when the scene got smaller, with a line that says how small it is now.
  std::function<void(const std::string&)> tell;
};

struct ShrunkScene {
  core::Scene scene;
  core::Verdict verdict;  // of that scene
  std::uint64_t trials = 0;
  double seconds = 0.0;
  bool is_out_of_time = false;  // time ran out: it could perhaps be smaller
};

// Judges a scene: ask() with a question, or a test's own function.
using Oracle = std::function<core::Result<TrialAnswer>(const core::Scene&)>;

// Repeats these steps, in this order, until none changes anything or time is up:
// frames (the run is cut before the fault and, where the engine has no memory but the bodies' states, started from the
// state just before it), bodies, springs, mesh triangles, settings of the scene that do not matter, and digits of
// positions, velocities, vertices and domain. Deterministic except for the time limit. At every moment the best scene
// so far gets the verdict of the whole scene, though perhaps by another fault under the same law. Errors: the whole
// scene's own, and a verdict that is neither fail nor inconclusive.
core::Result<ShrunkScene> shrink_scene(const core::Scene& scene, const Oracle& oracle, const ShrinkLimits& limits);

}  // namespace broadside::bench
