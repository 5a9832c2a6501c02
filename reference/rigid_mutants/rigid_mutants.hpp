// Wrong engines of bodies that turn: plain-rigid or octree-cpu with one stage replaced, and the law that must reject
// it.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/engine/dynamics.hpp"
#include "reference/rigid_mutants/staged_pipeline.hpp"
#include "reference/rigid_mutants/staged_world.hpp"

namespace broadside::reference {

struct RigidMutant {
  std::string_view name;   // "no-gyroscopic-term"
  std::string_view what;   // what is wrong, in a few words
  std::string_view law;    // the law that must reject it
  std::string_view scene;  // a scene in which the fault shows: bench/mutants/rigid_scenes
  RigidStages stages;
  bool differs_from_run_to_run = false;
  // The twin's stages, for pipeline_mutants() and rest_mutants(), which leave the stages above alone.
  TurningStages turning = {};
  bool is_of_pipeline = false;
};

// Four tables, by what is wrong.
std::span<const RigidMutant> flight_mutants();   // how bodies move and turn while they touch nothing
std::span<const RigidMutant> touch_mutants();    // where bodies touch, and what keeps them apart
std::span<const RigidMutant> impulse_mutants();  // impulses and friction
std::span<const RigidMutant> telling_mutants();  // right motion, recorded wrongly
// A fifth, of octree-cpu where bodies turn: each of its stages is broken at least once.
std::span<const RigidMutant> pipeline_mutants();
// A sixth, of its stages that are off by default: sleep, and the sweep of fast bodies.
std::span<const RigidMutant> rest_mutants();

std::unique_ptr<core::Dynamics> make_rigid_mutant(const RigidMutant& mutant, std::uint64_t run);

}  // namespace broadside::reference
