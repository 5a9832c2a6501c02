#include "bench/cli/turned_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "bench/cli/paint_order.hpp"
#include "reports/plots/shaded_model.hpp"

namespace broadside::bench {
namespace {

using reports::plots::Drawing;
using reports::plots::pixels;
using reports::plots::Point;
using reports::plots::Projected;

// A polyhedron with more visible faces than this is drawn as a smooth body, in four tones.
constexpr std::size_t kMostFaces = 16;
constexpr int kBrightest = 5;
// A corner is left out of an outline where it stands out by less than this, which is not visible.
constexpr double kLeastCorner = 0.15;  // px

// White or black over a body's color, in sixteenths, as on upright boxes: 4 on the top face, -4 on the right one.
std::string overlay(int tone) {
  return (tone > 0 ? "#fff" : "#000") + std::to_string(std::abs(tone));
}

core::Vec3 normal_of(const SeenBody& body, std::span<const std::uint32_t> polygon) {
  double x = 0.0, y = 0.0, z = 0.0;
  const core::Vec3 first = body.vertices[polygon[0]];
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const core::Vec3 a = body.vertices[polygon[k - 1]] - first, b = body.vertices[polygon[k]] - first;
    x += double(a.y) * b.z - double(a.z) * b.y;
    y += double(a.z) * b.x - double(a.x) * b.z;
    z += double(a.x) * b.y - double(a.y) * b.x;
  }
  const double length = std::max(std::sqrt(x * x + y * y + z * z), 1e-300);
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

// The tone of a flat face. The faces of upright boxes get the tones of pictures of boxes.
int tone_of(core::Vec3 normal) {
  return std::clamp(static_cast<int>(std::lround(4.0F * (normal.y - normal.x))), -kBrightest, kBrightest);
}

// Maps brightness to tones: -4 in the shade, 4 on a surface that faces the light (shaded_model.hpp).
double tone_of_brightness(double brightness) {
  return 4.0 * (brightness - 0.65) / 0.35;
}

std::string ring_of(const std::vector<Point>& corners) {
  std::string data;
  for (const Point& p : corners) data += (data.empty() ? "M" : "L") + pixels(p.x) + " " + pixels(p.y);
  return data.empty() ? data : data + "Z";
}

// Leaves out corners that do not show in the picture, such as those of a box whose sides are cut.
std::vector<Point> simplified(const std::vector<Point>& corners) {
  std::vector<Point> kept;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &p = corners[k], &next = corners[(k + 1) % corners.size()];
    const Point& before = kept.empty() ? corners.back() : kept.back();
    const double x = next.x - before.x, y = next.y - before.y, length = std::hypot(x, y);
    if (length > 0.0 && std::abs((p.x - before.x) * y - (p.y - before.y) * x) >= kLeastCorner * length)
      kept.push_back(p);
  }
  return kept.size() >= 3 ? kept : corners;
}

class BodyPainter {
 public:
  BodyPainter(Drawing& drawing, const SeenBody& body, std::string style, const PicturePlane& plane, double left)
      : drawing_(drawing), body_(body), style_(std::move(style)), plane_(plane), left_(left) {
    const SeenShape& shape = *body.shape;
    for (std::size_t k = 0; k < shape.polygons.size(); ++k) {
      if (!shape.is_convex || !body.faces_eye(shape.polygons[k])) continue;
      Face& face = faces_[shape.plane_of[k]];
      if (face.points.empty()) face.normal = normal_of(body, shape.polygons[k]);
      for (const std::uint32_t v : shape.polygons[k]) face.points.push_back(body.points[v]);
    }
  }

  void paint() {
    if (!body_.shape->is_convex)
      paint_raster();
    else if (faces_.size() <= kMostFaces)
      paint_faces();
    else
      paint_smooth();
  }

 private:
  struct Face {
    core::Vec3 normal;
    std::vector<Projected> points;  // the corners of its polygons
  };

  [[nodiscard]] std::vector<Point> placed(const std::vector<Projected>& points) const {
    std::vector<Point> out;
    out.reserve(points.size());
    for (const Projected& p : points) out.push_back(plane_.at(p, left_));
    return out;
  }

  [[nodiscard]] std::vector<Point> outline(const std::vector<Projected>& points) const {
    return simplified(placed(outline_of(points)));
  }

  // The outline around all faces to which light from the eye's upper left gives at least this tone.
  [[nodiscard]] std::vector<Point> outline_from(double tone) const {
    std::vector<Projected> points;
    for (const auto& [plane, face] : faces_)
      if (tone_of_brightness(reports::plots::brightness_toward(face.normal, kPictureView)) >= tone)
        points.insert(points.end(), face.points.begin(), face.points.end());
    return outline(points);
  }

  void paint_faces() {
    drawing_.path(style_, "", ring_of(outline(body_.points)));
    std::map<int, std::string> by_tone;
    for (const auto& [plane, face] : faces_) by_tone[tone_of(face.normal)] += ring_of(outline(face.points));
    for (const auto& [tone, data] : by_tone)
      if (tone != 0) drawing_.path("", overlay(tone), data);
  }

  // The polygons of a round body above a tone form a patch that looks convex. The region between the outline and the
  // patch of the middle tones is in the shade.
  void paint_smooth() {
    const std::string all = ring_of(outline_from(-kBrightest));
    drawing_.path(style_, "", all);
    std::vector<Point> lit = outline_from(-1.0);
    std::reverse(lit.begin(), lit.end());  // in the opposite direction it is a hole
    drawing_.path("", overlay(-3), all + ring_of(lit));
    for (const double tone : {1.5, 3.0}) drawing_.path("", overlay(2), ring_of(outline_from(tone)));
  }

  // Draws the shape as rows of pixels, with a rectangle for each run of equal pixels.
  void paint_raster() {
    core::Mesh mesh;
    mesh.vertices = body_.vertices;
    for (const auto& t : body_.shape->polygons) mesh.triangles.push_back({t[0], t[1], t[2]});
    double from_x = 1e300, to_x = -1e300, from_y = 1e300, to_y = -1e300;
    for (const Point& p : placed(body_.points)) {
      from_x = std::min(from_x, p.x), to_x = std::max(to_x, p.x);
      from_y = std::min(from_y, p.y), to_y = std::max(to_y, p.y);
    }
    const double column = std::floor(from_x), row = std::floor(from_y);
    const auto side = static_cast<std::uint32_t>(std::max(to_x - column, to_y - row)) + 1;
    const reports::plots::Window window{plane_.left + (column - left_) / plane_.scale,
                                        plane_.top - (row - kHead) / plane_.scale, side / plane_.scale};
    const reports::plots::Raster raster = reports::plots::shade_model(mesh, kPictureView, window, side);
    const auto tone_at = [&](std::uint32_t x, std::uint32_t y) {
      const float value = raster.brightness[std::size_t{y} * side + x];
      return value < 0.0F ? kNothing : 2 * static_cast<int>(std::lround(0.5 * tone_of_brightness(value)));
    };
    std::string covered;
    std::map<int, std::string> by_tone;
    // Calls `take` for each run of cells; a run is as long as `same` holds between its first cell and the next.
    const auto each_run = [&](auto same, auto take) {
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0, end = 0; x < side; x = end) {
          const int tone = tone_at(x, y);
          for (end = x + 1; end < side && same(tone, tone_at(end, y));) ++end;
          if (tone != kNothing) take(tone, x, y, end - x);
        }
    };
    const auto rectangle = [&](std::uint32_t x, std::uint32_t y, std::uint32_t width, const char* height) {
      return "M" + pixels(column + x) + " " + pixels(row + y) + "h" + pixels(width) + "v" + height + "h-" +
             pixels(width) + "z";
    };
    // A little taller than the row, so that no line of the background shows between rows.
    each_run([](int a, int b) { return (a == kNothing) == (b == kNothing); },
             [&](int, std::uint32_t x, std::uint32_t y, std::uint32_t n) { covered += rectangle(x, y, n, "1.2"); });
    each_run([](int a, int b) { return a == b; },
             [&](int tone, std::uint32_t x, std::uint32_t y, std::uint32_t n) {
               if (tone != 0) by_tone[tone] += rectangle(x, y, n, "1");
             });
    drawing_.path(style_, "", covered);
    for (const auto& [tone, data] : by_tone) drawing_.path("", overlay(tone), data);
  }

  static constexpr int kNothing = -100;

  Drawing& drawing_;
  const SeenBody& body_;
  std::string style_;
  const PicturePlane& plane_;
  double left_;
  std::map<std::uint32_t, Face> faces_;  // of a convex body: the faces toward the eye, by plane
};

}  // namespace

void draw_turned(Drawing& drawing, const core::Scene& scene, std::span<const SeenBody> bodies,
                 const PicturePlane& plane, double panel_left) {
  std::vector<SeenBody> moving;
  std::vector<std::size_t> index;
  std::string outlines;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (scene.bodies[b].inverse_mass > 0.0F) {
      moving.push_back(bodies[b]);
      index.push_back(b);
      continue;
    }
    std::vector<Point> corners;
    for (const Projected& p : outline_of(bodies[b].points)) corners.push_back(plane.at(p, panel_left));
    outlines += ring_of(corners);
  }
  for (const std::size_t k : paint_order(moving, plane))
    BodyPainter(drawing, moving[k], "s" + std::to_string(index[k] % 8), plane, panel_left).paint();
  drawing.path("frame", "", outlines);
}

}  // namespace broadside::bench
