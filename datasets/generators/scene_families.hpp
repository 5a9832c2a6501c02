// The families of scenes, one source file each, and the one table of them. METHOD section 9 fixes what the paper leaves
// open about its two scenes.
#pragma once

#include <span>
#include <string_view>

#include "datasets/generators/scene_family.hpp"

namespace broadside::datasets {

// Macros make the declarations and the table from one list, so that no family can be missing from either.
#define SCENE_FAMILY(function) SceneFamily function();
#include "datasets/generators/scene_families.inc"
#undef SCENE_FAMILY

std::span<const SceneFamily> scene_families();
// Null when there is no family with this name.
const SceneFamily* find_family(std::string_view name);

}  // namespace broadside::datasets
