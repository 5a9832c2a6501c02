// Draws bodies that turn into a picture of a scene: their true outlines, shaded by the directions of their faces.
#pragma once

#include <cstddef>
#include <span>

#include "bench/cli/picture_plane.hpp"
#include "bench/cli/seen_body.hpp"
#include "core/scene/scene.hpp"
#include "reports/plots/drawing.hpp"

namespace broadside::bench {

// bodies: all bodies of the scene. Static ones are drawn as outlines over the others, as where bodies translate.
void draw_turned(reports::plots::Drawing& drawing, const core::Scene& scene, std::span<const SeenBody> bodies,
                 const PicturePlane& plane, double panel_left);

}  // namespace broadside::bench
