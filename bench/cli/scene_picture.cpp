#include "bench/cli/scene_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/shapes.hpp"
#include "reports/plots/drawing.hpp"
#include "reports/plots/model_picture.hpp"

namespace broadside::bench {
namespace {

using reports::plots::pixels;
using reports::plots::Point;
using reports::plots::Projected;

constexpr double kPanel = 320.0;
constexpr double kHead = 44.0;
constexpr double kEdge = 8.0;
// The view is from above, in front and to the right, so the faces toward +x, +y and +z are visible.
constexpr reports::plots::View kView{28.0, 20.0};

// A corner of a box: bit k set = max on axis k.
Projected corner(const core::Box& box, unsigned bits) {
  core::Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = ((bits >> k) & 1U) != 0 ? box.max[k] : box.min[k];
  return reports::plots::project(p, kView);
}

// Corners around each visible face, and around all three together.
constexpr std::array<unsigned, 4> kRight{1, 3, 7, 5};
constexpr std::array<unsigned, 4> kTop{2, 6, 7, 3};
constexpr std::array<unsigned, 6> kOutline{0, 1, 5, 4, 6, 2};
constexpr std::array<unsigned, 6> kSilhouette{4, 5, 1, 3, 2, 6};
constexpr std::array<unsigned, 4> kFloor{0, 1, 5, 4};

struct Frame {
  double left = 0.0, top = 0.0, scale = 1.0;  // of the projection plane, in pixels a meter

  [[nodiscard]] Point at(const Projected& p, double panel_left) const {
    const auto tenth = [](double v) { return std::round(v * 10.0) / 10.0; };
    return {tenth(panel_left + (p.x - left) * scale), tenth(kHead + (top - p.y) * scale)};
  }
};

template <std::size_t N>
std::string ring(const core::Box& box, const std::array<unsigned, N>& corners, const Frame& frame, double panel_left) {
  std::string data;
  for (const unsigned c : corners) {
    const Point p = frame.at(corner(box, c), panel_left);
    data += (data.empty() ? "M" : "L") + pixels(p.x) + " " + pixels(p.y);
  }
  return data + "Z";
}

std::vector<core::Box> boxes_of(const core::Scene& scene, const core::ShapeTable& shapes, const ScenePanel& panel) {
  std::vector<core::Box> boxes;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    boxes.push_back(core::translated(shapes.shapes[shapes.shape_of_body[b]].octree.boxes[0], panel.positions[b]));
  return boxes;
}

core::Box box_around(std::span<const std::vector<core::Box>> panels) {
  core::Box all = core::empty_box();
  for (const auto& boxes : panels)
    for (const core::Box& b : boxes) all = core::grown(core::grown(all, b.min), b.max);
  return all;
}

// Which part of the domain is drawn: all of it where the bodies fill it, else the floor under them.
core::Box drawn_domain(const core::Scene& scene, const core::Box& bodies) {
  core::Box d = scene.domain;
  float longest = 0.0F;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, bodies.max[k] - bodies.min[k]);
  for (int k = 0; k < 3; ++k) {
    const float margin = 0.08F * longest;
    d.min[k] = std::max(d.min[k], bodies.min[k] - margin);
    d.max[k] = std::min(d.max[k], bodies.max[k] + margin);
  }
  return d;
}

Frame frame_for(const core::Box& shown) {
  double left = 1e300, right = -1e300, low = 1e300, top = -1e300;
  for (unsigned c = 0; c < 8; ++c) {
    const Projected p = corner(shown, c);
    left = std::min(left, p.x), right = std::max(right, p.x);
    low = std::min(low, p.y), top = std::max(top, p.y);
  }
  const double room = kPanel - 2.0 * kEdge;
  const double scale = room / std::max({right - left, top - low, 1e-9});
  // Centered in the panel.
  return {0.5 * (left + right) - 0.5 * kPanel / scale, 0.5 * (low + top) + 0.5 * kPanel / scale, scale};
}

void draw_panel(reports::plots::Drawing& drawing, const core::Scene& scene, const std::vector<core::Box>& boxes,
                const core::Box& domain, const Frame& frame, double left) {
  drawing.path("grid", "", ring(domain, kFloor, frame, left) + ring(domain, kOutline, frame, left));
  std::vector<std::size_t> order;
  std::string outlines;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (scene.bodies[b].inverse_mass > 0.0F)
      order.push_back(b);
    else
      outlines += ring(boxes[b], kSilhouette, frame, left);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
    const double nearer_p = reports::plots::project(core::center(boxes[p]), kView).toward_eye;
    const double nearer_q = reports::plots::project(core::center(boxes[q]), kView).toward_eye;
    return nearer_p != nearer_q ? nearer_p < nearer_q : p < q;
  });
  for (const std::size_t b : order) {
    drawing.path("s" + std::to_string(b % 8), "", ring(boxes[b], kSilhouette, frame, left));
    drawing.path("", "#0004", ring(boxes[b], kRight, frame, left));
    drawing.path("", "#fff4", ring(boxes[b], kTop, frame, left));
  }
  if (!outlines.empty()) drawing.path("frame", "", outlines);
}

}  // namespace

std::string scene_svg(const core::Scene& scene, std::span<const ScenePanel> panels) {
  const core::ShapeTable shapes = core::build_shapes(scene);
  std::vector<std::vector<core::Box>> boxes;
  for (const ScenePanel& panel : panels) boxes.push_back(boxes_of(scene, shapes, panel));
  const core::Box around = box_around(boxes);
  const core::Box domain = core::is_empty(around) ? scene.domain : drawn_domain(scene, around);
  const Frame frame = frame_for(domain);
  const double width = kPanel * static_cast<double>(panels.size());
  reports::plots::Drawing drawing(width, kHead + kPanel, scene.name,
                                  scene.description + ". Bodies are drawn as their boxes, static ones as outlines.");
  drawing.text("heading", {kEdge, 17.0}, reports::plots::Anchor::kStart, scene.name);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double left = kPanel * static_cast<double>(p);
    drawing.text("tick", {left + kEdge, 34.0}, reports::plots::Anchor::kStart, panels[p].caption);
    draw_panel(drawing, scene, boxes[p], domain, frame, left);
  }
  return drawing.finish(reports::plots::Placement::kFile);
}

}  // namespace broadside::bench
