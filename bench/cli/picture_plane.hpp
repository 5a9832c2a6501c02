// Where the picture of a scene puts a point of the world: parallel projection, panels side by side.
#pragma once

#include <cmath>

#include "reports/plots/drawing.hpp"
#include "reports/plots/model_picture.hpp"

namespace broadside::bench {

inline constexpr double kPanel = 320.0;  // px: a panel's width and height
inline constexpr double kHead = 44.0;    // px above the panels for heading and captions
inline constexpr double kEdge = 8.0;     // px that stay empty around what is drawn
// The view is from above, from the front and from the right, so the faces toward +x, +y and +z are visible.
inline constexpr reports::plots::View kPictureView{28.0, 20.0};

struct PicturePlane {
  double left = 0.0, top = 0.0, scale = 1.0;  // of the projection plane, in pixels a meter

  // The pixel position of a point in the panel whose left edge is given, to a tenth of a pixel.
  [[nodiscard]] reports::plots::Point at(const reports::plots::Projected& p, double panel_left) const {
    const auto tenth = [](double v) { return std::round(v * 10.0) / 10.0; };
    return {tenth(panel_left + (p.x - left) * scale), tenth(kHead + (top - p.y) * scale)};
  }
};

}  // namespace broadside::bench
