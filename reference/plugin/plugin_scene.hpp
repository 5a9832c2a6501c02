// A scene in the C interface's structs. They point into the scene: keep both.
#pragma once

#include <vector>

#include "core/plugin/broadside_engine.h"
#include "core/scene/scene.hpp"

namespace broadside::reference {

class PluginScene {
 public:
  explicit PluginScene(const core::Scene& scene);
  PluginScene(const PluginScene&) = delete;
  PluginScene& operator=(const PluginScene&) = delete;

  [[nodiscard]] const broadside_scene* c_struct() const { return &scene_; }

 private:
  std::vector<broadside_mesh> meshes_;
  std::vector<broadside_body> bodies_;
  broadside_scene scene_{};
};

broadside_mesh mesh_to_c(const core::Mesh& mesh);
// Field by field: the C structs have no padding that could hide a difference.
broadside_state state_to_c(core::Vec3 position, core::Quat orientation, core::Vec3 velocity, core::Vec3 angular);
core::Vec3 vec3_from_c(const float (&v)[3]);
core::Quat quat_from_c(const float (&q)[4]);

}  // namespace broadside::reference
