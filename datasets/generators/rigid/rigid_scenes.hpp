// Scenes whose outcome is known in closed form, one file per group, and the one list of the groups.
#pragma once

#include <span>
#include <vector>

#include "datasets/generators/small_scenes.hpp"

namespace broadside::datasets {

// Macros make the declarations and the table from one list.
#define RIGID_SCENES(function) std::span<const SmallSceneRow> function();
#include "datasets/generators/rigid/rigid_scenes.inc"
#undef RIGID_SCENES

// All scenes of all groups: their names begin with "rigid:".
std::span<const SmallSceneRow> rigid_scenes();

}  // namespace broadside::datasets
