// The scene of a cell of the paper's experiments.
#pragma once

#include "bench/paper/paper_plan.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench::paper {

// METHOD 9's step of the penetration study, s.
inline constexpr float kPenetrationDt_s = 0.001F;

// Built-in scenes by name. A cell with beta has these parameters and dt = 0.001 s, and starts when the lowest box
// reaches the floor: at that step 3000 frames are 3 s, and free flight, during which nothing touches, would take a
// third of a second of it.
core::Result<core::Scene> make_paper_scene(const PaperCell& cell, bool allow_stand_in);

// Moves every body on in free flight, in closed form, until the lowest box touches the floor y = domain.min.y. No
// bodies may touch before that, and none touch after it. A scene that has no gravity along -y, or whose lowest box is
// on the floor already, is left as it is.
void fly_to_floor(core::Scene& scene);

}  // namespace broadside::bench::paper
