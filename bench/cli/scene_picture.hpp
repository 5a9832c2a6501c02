// A scene as a small picture: bodies flat-shaded, static ones as outlines.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// One moment of the scene.
struct ScenePanel {
  std::string caption;
  std::vector<core::Vec3> positions;     // of all bodies, m
  std::vector<core::Quat> orientations;  // likewise; read where bodies turn
};

// SVG, panels side by side in one scale: parallel projection, y upward, nearer bodies over farther ones. Bodies that
// translate are drawn as their boxes, from which contacts are also made; bodies that turn are drawn in their shapes and
// orientations.
std::string scene_svg(const core::Scene& scene, std::span<const ScenePanel> panels);

}  // namespace broadside::bench
