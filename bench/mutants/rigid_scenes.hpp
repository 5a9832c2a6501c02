// The small scenes of bodies that turn, on which wrong engines and spoiled traces of the laws of mechanics are tried.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// Bodies of "rigid-mixed": 0 and 1 are bricks that spin in the air, 2 slides over the floor, 3 is a ball that bounces,
// 4 and 5 meet in the air, off center, 6 rests on the floor and 7 on it, 8 is a static block, and 9 is a ball that
// drops on it.
// "rigid-stack" stands on the floor; "rigid-overlap" starts with bodies in each other; "rigid-offset" is a box on the
// edge of another; in "rigid-fast" and "rigid-blade" a body moves farther in a step than the body that it meets is
// thick; "rigid-million" spins at 1e6 rad/s; "rigid-bounce", "rigid-flight", "rigid-slide" and "rigid-spin-up" have an
// exact answer.
core::Result<core::Scene> rigid_scene(std::string_view name);

// Boxes and spheres of random sizes, masses, spins and materials in a box of 4 m, from the seed, at the step dt.
core::Scene random_rigid_scene(std::uint32_t seed, float dt_s, std::uint32_t frames);

}  // namespace broadside::bench
