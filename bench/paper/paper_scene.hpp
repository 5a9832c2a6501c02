// The scene of a cell of the paper's experiments.
#pragma once

#include "bench/paper/paper_plan.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench::paper {

// METHOD 9's step of the penetration study, s.
inline constexpr float kPenetrationDt_s = 0.001F;

// Built-in scenes by name. The scene of a cell with beta has these parameters and dt = 0.001 s, and starts when the
// lowest box reaches the floor. At that step 3000 frames are 3 s, of which the free flight, in which nothing touches,
// would take a third of a second.
core::Result<core::Scene> make_paper_scene(const PaperCell& cell, bool allow_stand_in);

// Moves every body on in free flight, in closed form, until the lowest box touches the floor y = domain.min.y. No
// bodies may touch before that, and none touch in the result. Leaves a scene as it is when it has no gravity along -y
// or its lowest box is on the floor already.
void fly_to_floor(core::Scene& scene);

}  // namespace broadside::bench::paper
