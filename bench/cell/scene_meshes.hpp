// A scene whose meshes are fetched first where this machine lacks them.
#pragma once

#include "bench/cell/scene_arguments.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// Fetches what can be fetched before a procedural body stands in: offline, the work still goes on, and its report says
// so. A mesh that could not be fetched is not asked for again by this process. Without wanted.allow_stand_in nothing
// stands in: the error says what is missing.
core::Result<core::Scene> make_scene_with_meshes(const SceneArguments& wanted);

}  // namespace broadside::bench
