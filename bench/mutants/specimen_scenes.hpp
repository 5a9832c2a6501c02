// The small scenes on which mutants and tamperings are tried; each contains what some law needs in order to apply.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// Unequal masses that meet in the air, a static block, a body that drops on it, one that slides over the floor into a
// wall, and two far apart. mesh: a cube of side 1 around the origin with squares of 1/4.
core::Scene mixed_scene(std::shared_ptr<const core::Mesh> mesh);

// Twelve cubes in a box of 4 m with masses, materials and parameters drawn from the seed; two of them are static.
core::Scene random_scene(std::uint32_t seed, float origin_m, float largest_mass_ratio);

// By the name in the mutants' table: "mixed", "pile", "ties" ..., or any built-in scene.
core::Result<core::Scene> specimen_scene(std::string_view name);

}  // namespace broadside::bench
