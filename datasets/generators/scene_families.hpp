// The families of scenes, one source file each, and the one table of them. What the paper leaves open of its two scenes
// is fixed as METHOD section 9 says.
#pragma once

#include <span>
#include <string_view>

#include "datasets/generators/scene_family.hpp"

namespace broadside::datasets {

// Macros make declarations and table of one list, so that neither can lack a family.
#define SCENE_FAMILY(function) SceneFamily function();
#include "datasets/generators/scene_families.inc"
#undef SCENE_FAMILY

std::span<const SceneFamily> scene_families();
// Null when there is none of this name.
const SceneFamily* find_family(std::string_view name);

}  // namespace broadside::datasets
