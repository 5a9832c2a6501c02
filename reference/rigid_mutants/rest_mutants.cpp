// octree-cpu where bodies turn, with sleep and the sweep of fast bodies switched on, and one stage replaced.
#include <array>
#include <vector>

#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/sleep.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::reference {
namespace {

using core::RigidState;

// In steps 60 to 89 of the scene "rigid-nap" the falling body is put back and stopped.
void hold_in_the_air(StagedPipeline& p, float dt_s) {
  p.sound_fall_asleep(dt_s);
  if (p.step_number() < 60) return;
  RigidState& falling = p.bodies_.state.back();
  if (p.step_number() < 90) {
    falling.x = p.bodies_.detected.back().x;
    falling = core::stopped(falling);
  }
}

// Treats a body as still when no point of it moves at 4 m/s or faster.
void stop_at_any_speed(StagedPipeline& p, float dt_s) {
  p.sound_fall_asleep(dt_s);
  for (std::uint32_t i = 0; i < p.bodies_.count(); ++i) {
    const float outer_m = p.bodies_.shapes[p.bodies_.shape[i]].balls.outer_m;
    const float speed = core::fastest_of_body_m_s(p.bodies_.state[i], p.bodies_.mass[i], outer_m);
    if (p.bodies_.is_static[i] == 0 && !p.points_.empty() && speed < 4.0F)
      p.bodies_.state[i] = core::stopped(p.bodies_.state[i]);
  }
}

// Finds no contact between bodies. If it did, one might be found by chance, because the parts of a step are so short
// that a fast ball may be inside the plate at the end of one.
void touch_nobody(StagedPipeline& /*p*/) {}

std::span<const RigidMutant> rest_table() {
  static const auto kTable = [] {
    auto rows = std::to_array<RigidMutant>({
        {"twin: sleeps-in-the-air",
         "a falling body is stopped and held",
         "ballistic",
         "rigid-nap",
         {},
         false,
         {.fall_asleep = hold_in_the_air, .sleeps = true}},
        {"twin: sleeps-at-any-speed",
         "bodies that still move fast are stopped",
         "momentum",
         "rigid-nap",
         {},
         false,
         {.fall_asleep = stop_at_any_speed, .sleeps = true}},
        {"twin: sleeps-through-a-blow",
         "a sleeping body that is struck stays asleep",
         "momentum",
         "rigid-nap",
         {},
         false,
         {.wake = [](StagedPipeline&) {}, .sleeps = true}},
        {"twin: stops-nobody-on-the-way",
         "fast bodies without a contact are not stopped before they pass through others",
         "passage",
         "rigid-fast",
         {},
         false,
         {.touch_bodies = touch_nobody,
          .stop_short = [](StagedPipeline&) -> core::Status { return core::Done{}; },
          .sweeps_fast = true}},
    });
    for (RigidMutant& row : rows) row.is_of_pipeline = true;
    return rows;
  }();
  return kTable;
}

}  // namespace

std::span<const RigidMutant> rest_mutants() {
  return rest_table();
}

}  // namespace broadside::reference
