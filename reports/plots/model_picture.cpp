#include "reports/plots/model_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "reports/plots/shaded_model.hpp"

namespace broadside::reports::plots {
namespace {

constexpr double kSide = 300.0;        // px of the picture's square
constexpr double kHead = 30.0;         // px above it for the title
constexpr double kModelMargin = 0.04;  // share of the square that stays empty around the model
constexpr std::uint32_t kCells = 220;
constexpr int kShades = 10;

core::Vec3 corner_of(const core::Box& b, unsigned k) {
  return {(k & 1U) != 0 ? b.max.x : b.min.x, (k & 2U) != 0 ? b.max.y : b.min.y, (k & 4U) != 0 ? b.max.z : b.min.z};
}

// The square around everything that is drawn.
Window window_of(const core::Mesh& mesh, std::span<const core::Box> boxes, const View& view) {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
  const auto add = [&](core::Vec3 v) {
    const Projected p = project(v, view);
    left = std::min(left, p.x), right = std::max(right, p.x);
    bottom = std::min(bottom, p.y), top = std::max(top, p.y);
  };
  for (const core::Vec3& v : mesh.vertices) add(v);
  for (const core::Box& b : boxes)
    for (unsigned k = 0; k < 8 && !core::is_empty(b); ++k) add(corner_of(b, k));
  if (!(left <= right)) return {};
  const double side = std::max({right - left, top - bottom, 1e-12}) * (1.0 + 2.0 * kModelMargin);
  return {0.5 * (left + right) - 0.5 * side, 0.5 * (bottom + top) + 0.5 * side, side};
}

// One path per shade: horizontal runs of cells of that shade, each one rectangle.
void draw_model(Drawing& drawing, const Raster& raster) {
  std::array<std::string, kShades> runs;
  const double cell = kSide / raster.side;
  const auto shade_at = [&](std::uint32_t x, std::uint32_t y) {
    const float value = raster.brightness[std::size_t{y} * raster.side + x];
    return value < 0.0F ? -1 : std::clamp(static_cast<int>(value * kShades), 0, kShades - 1);
  };
  for (std::uint32_t y = 0; y < raster.side; ++y) {
    for (std::uint32_t x = 0; x < raster.side;) {
      const int shade = shade_at(x, y);
      std::uint32_t end = x + 1;
      while (end < raster.side && shade_at(end, y) == shade) ++end;
      // Slightly taller than the row, so that no line of the background shows between rows.
      if (shade >= 0)
        runs[static_cast<std::size_t>(shade)] += "M" + pixels(x * cell) + " " + pixels(kHead + y * cell) + "h" +
                                                 pixels((end - x) * cell) + "v" + pixels(cell + 0.25) + "h" +
                                                 pixels((double(x) - double(end)) * cell) + "z";
      x = end;
    }
  }
  for (int k = 0; k < kShades; ++k) {
    const std::string level = std::to_string(60 + (k * 165) / (kShades - 1));
    drawing.path("model", "rgb(" + level + "," + level + "," + level + ")", runs[static_cast<std::size_t>(k)]);
  }
}

// Draws the twelve edges of each box. The three edges at the corner that is farthest from the eye are behind the box.
void draw_boxes(Drawing& drawing, std::span<const core::Box> boxes, const View& view, const Window& window) {
  std::string before;
  std::string behind;
  for (const core::Box& box : boxes) {
    if (core::is_empty(box)) continue;
    std::array<Projected, 8> corners;
    for (unsigned k = 0; k < 8; ++k) corners[k] = project(corner_of(box, k), view);
    const auto farthest = static_cast<unsigned>(
        std::min_element(corners.begin(), corners.end(),
                         [](const Projected& a, const Projected& b) { return a.toward_eye < b.toward_eye; }) -
        corners.begin());
    for (unsigned k = 0; k < 8; ++k) {
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        if ((k & axis) != 0) continue;
        const unsigned other = k | axis;
        const auto at = [&](unsigned c) {
          return pixels((corners[c].x - window.left) * kSide / window.side) + " " +
                 pixels(kHead + (window.top - corners[c].y) * kSide / window.side);
        };
        (k == farthest || other == farthest ? behind : before) += "M" + at(k) + "L" + at(other);
      }
    }
  }
  drawing.path("model-box behind", "", behind);
  drawing.path("model-box", "", before);
}

}  // namespace

Projected project(core::Vec3 point, const View& view) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  const double a = view.azimuth_deg * kRadians;
  const double e = view.elevation_deg * kRadians;
  const double x = point.x, y = point.y, z = point.z;
  const double forward = x * std::sin(a) + z * std::cos(a);
  return {x * std::cos(a) - z * std::sin(a), y * std::cos(e) - forward * std::sin(e),
          y * std::sin(e) + forward * std::cos(e)};
}

std::string svg(const ModelPicture& picture, const core::Mesh& mesh, std::span<const core::Box> boxes,
                Placement placement) {
  Drawing drawing(kSide, kHead + kSide, picture.title, picture.description);
  drawing.text("heading", {10.0, 20.0}, Anchor::kStart, picture.title);
  const Window window = window_of(mesh, boxes, picture.view);
  if (!mesh.triangles.empty()) draw_model(drawing, shade_model(mesh, picture.view, window, kCells));
  draw_boxes(drawing, boxes, picture.view, window);
  return drawing.finish(placement);
}

}  // namespace broadside::reports::plots
