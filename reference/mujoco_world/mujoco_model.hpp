// The scene as text in MuJoCo's own format, MJCF.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "reference/mujoco_world/mujoco_world.hpp"
#include "reference/rigid_world/rigid_start.hpp"

namespace broadside::reference {

// Geoms in the order: the six faces of the domain, then one for each body. Each body that moves is placed by its center
// of mass and has a free joint, or three sliding ones where the scene's bodies translate.
std::string mujoco_model(const core::Scene& scene, const std::vector<RigidStart>& bodies, const MujocoOptions& options);

}  // namespace broadside::reference
