// A scene in the structs of version 2 of the C interface. They point into the scene: keep both.
#pragma once

#include <memory>
#include <vector>

#include "core/plugin/broadside_engine_v2.h"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::reference {

class PluginScene2 {
 public:
  // The error of a body whose inertia is not defined, where bodies turn.
  static core::Result<std::unique_ptr<PluginScene2>> of(const core::Scene& scene);
  PluginScene2(const PluginScene2&) = delete;
  PluginScene2& operator=(const PluginScene2&) = delete;

  [[nodiscard]] const broadside_scene2* c_struct() const { return &scene_; }

 private:
  PluginScene2() = default;
  core::Status add_bodies(const core::Scene& scene);

  std::vector<broadside_mesh> meshes_;
  std::vector<broadside_shape> shapes_;
  std::vector<broadside_body2> bodies_;
  std::vector<broadside_wrench> wrenches_;
  broadside_scene2 scene_{};
};

}  // namespace broadside::reference
