// A scene whose meshes are fetched first where this machine lacks them.
#pragma once

#include "bench/cell/scene_arguments.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// Tries to fetch a mesh before a procedural body takes its place. Without a network the work still goes on, and the
// report says which meshes were replaced. This process does not try a mesh again that could not be fetched. Without
// wanted.allow_stand_in a missing mesh is an error that names it.
core::Result<core::Scene> make_scene_with_meshes(const SceneArguments& wanted);

}  // namespace broadside::bench
