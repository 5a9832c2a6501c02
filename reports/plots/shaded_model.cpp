#include "reports/plots/shaded_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace broadside::reports::plots {
namespace {

constexpr std::uint32_t kFiner = 2;  // depth-buffer cells per raster cell and axis
constexpr double kAmbient = 0.3;

struct Corner {
  double x, y, depth;  // in depth-buffer cells; depth toward the eye
  double brightness;
};

// Vertex normals as the eye sees them: the sum of twice the area vectors of the triangles at the vertex.
std::vector<Projected> vertex_normals(const core::Mesh& mesh, const std::vector<Projected>& points) {
  std::vector<Projected> normals(points.size());
  for (const core::Triangle& t : mesh.triangles) {
    const Projected &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const Projected u{b.x - a.x, b.y - a.y, b.toward_eye - a.toward_eye};
    const Projected v{c.x - a.x, c.y - a.y, c.toward_eye - a.toward_eye};
    const Projected n{u.y * v.toward_eye - u.toward_eye * v.y, u.toward_eye * v.x - u.x * v.toward_eye,
                      u.x * v.y - u.y * v.x};
    for (const std::uint32_t corner : t) {
      normals[corner].x += n.x;
      normals[corner].y += n.y;
      normals[corner].toward_eye += n.toward_eye;
    }
  }
  return normals;
}

// Lambert's law with the light at the eye's upper left; a surface that faces away from it gets ambient light only.
double brightness_of(Projected n) {
  const double size = std::sqrt(n.x * n.x + n.y * n.y + n.toward_eye * n.toward_eye);
  if (!(size > 0.0)) return kAmbient;
  constexpr std::array<double, 3> kLight{-0.40, 0.52, 0.755};
  const double facing = (kLight[0] * n.x + kLight[1] * n.y + kLight[2] * n.toward_eye) / size;
  return kAmbient + (1.0 - kAmbient) * std::max(0.0, facing);
}

class DepthBuffer {
 public:
  explicit DepthBuffer(std::uint32_t side)
      : side_(side),
        depth_(std::size_t{side} * side, -std::numeric_limits<double>::infinity()),
        brightness_(std::size_t{side} * side, -1.0F) {}

  void draw(const std::array<Corner, 3>& t) {
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    const int x0 = std::max(0, static_cast<int>(std::ceil(left - 0.5)));
    const int y0 = std::max(0, static_cast<int>(std::ceil(top - 0.5)));
    const int x1 = std::min(static_cast<int>(side_) - 1, static_cast<int>(std::floor(right - 0.5)));
    const int y1 = std::min(static_cast<int>(side_) - 1, static_cast<int>(std::floor(bottom - 0.5)));
    for (int y = y0; y <= y1 && area != 0.0; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double w1 = ((px - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (py - t[0].y)) / area;
        const double w2 = ((t[1].x - t[0].x) * (py - t[0].y) - (px - t[0].x) * (t[1].y - t[0].y)) / area;
        const double w0 = 1.0 - w1 - w2;
        if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0) continue;
        put(x, y, w0 * t[0].depth + w1 * t[1].depth + w2 * t[2].depth,
            w0 * t[0].brightness + w1 * t[1].brightness + w2 * t[2].brightness);
      }
    }
    // A triangle smaller than a cell may cover no cell's center: its first corner stands for it.
    if (x1 < x0 || y1 < y0)
      put(static_cast<int>(std::floor(t[0].x)), static_cast<int>(std::floor(t[0].y)), t[0].depth, t[0].brightness);
  }

  [[nodiscard]] float at(std::uint32_t x, std::uint32_t y) const { return brightness_[std::size_t{y} * side_ + x]; }

 private:
  void put(int x, int y, double depth, double brightness) {
    if (x < 0 || y < 0 || x >= static_cast<int>(side_) || y >= static_cast<int>(side_)) return;
    const std::size_t cell = static_cast<std::size_t>(y) * side_ + static_cast<std::size_t>(x);
    if (depth <= depth_[cell]) return;
    depth_[cell] = depth;
    brightness_[cell] = static_cast<float>(brightness);
  }

  std::uint32_t side_;
  std::vector<double> depth_;
  std::vector<float> brightness_;
};

}  // namespace

double brightness_toward(core::Vec3 normal, const View& view) {
  return brightness_of(project(normal, view));
}

Raster shade_model(const core::Mesh& mesh, const View& view, const Window& window, std::uint32_t side) {
  std::vector<Projected> points;
  points.reserve(mesh.vertices.size());
  for (const core::Vec3& v : mesh.vertices) points.push_back(project(v, view));
  const std::vector<Projected> normals = vertex_normals(mesh, points);

  DepthBuffer buffer(side * kFiner);
  const double scale = side * kFiner / window.side;
  for (const core::Triangle& t : mesh.triangles) {
    std::array<Corner, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Projected& p = points[t[k]];
      corners[k] = {(p.x - window.left) * scale, (window.top - p.y) * scale, p.toward_eye,
                    brightness_of(normals[t[k]])};
    }
    buffer.draw(corners);
  }

  Raster raster{side, std::vector<float>(std::size_t{side} * side, -1.0F)};
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      float sum = 0.0F;
      std::uint32_t covered = 0;
      for (std::uint32_t k = 0; k < kFiner * kFiner; ++k) {
        const float value = buffer.at(x * kFiner + k % kFiner, y * kFiner + k / kFiner);
        if (value < 0.0F) continue;
        sum += value;
        ++covered;
      }
      if (2 * covered >= kFiner * kFiner)
        raster.brightness[std::size_t{y} * side + x] = sum / static_cast<float>(covered);
    }
  }
  return raster;
}

}  // namespace broadside::reports::plots
