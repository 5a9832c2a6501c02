// A scene as a small picture: bodies as flat-shaded boxes, static ones as outlines.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/math/vec3.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// One moment of the scene.
struct ScenePanel {
  std::string caption;
  std::vector<core::Vec3> positions;  // of all bodies, m
};

// SVG, panels side by side in one scale: parallel projection, y upward, nearer bodies over farther ones. Bodies are
// drawn as their boxes, which is also what contacts are made from.
std::string scene_svg(const core::Scene& scene, std::span<const ScenePanel> panels);

}  // namespace broadside::bench
