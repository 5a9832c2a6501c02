// The families of scenes, one source file each, and the one table of them.
#pragma once

#include <span>
#include <string_view>

#include "datasets/generators/scene_family.hpp"

namespace broadside::datasets {

// The two scenes of the method's experiments, with what the paper leaves open fixed as METHOD section 9 says. P-Table
// A1: free-fall stacking, at rest in a stacked grid. P-Tables 5 and 6: "randomly moving" bodies in a cube without
// gravity, whose faces bounce fully and do not rub.
SceneFamily freefall_family();
SceneFamily random_move_family();

SceneFamily tower_family();
SceneFamily pyramid_family();
SceneFamily domino_family();
SceneFamily wall_family();
SceneFamily drum_family();
SceneFamily funnel_family();
SceneFamily hopper_family();
SceneFamily mixed_sizes_family();
SceneFamily same_point_family();
SceneFamily static_family();

std::span<const SceneFamily> scene_families();
// Null when there is none of this name.
const SceneFamily* find_family(std::string_view name);

}  // namespace broadside::datasets
