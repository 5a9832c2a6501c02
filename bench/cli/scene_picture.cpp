#include "bench/cli/scene_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/cli/picture_plane.hpp"
#include "bench/cli/seen_body.hpp"
#include "bench/cli/turned_picture.hpp"
#include "core/scene/shapes.hpp"
#include "reports/plots/drawing.hpp"
#include "reports/plots/model_picture.hpp"

namespace broadside::bench {
namespace {

using reports::plots::pixels;
using reports::plots::Point;
using reports::plots::Projected;

// A corner of a box: bit k set = max on axis k.
Projected corner(const core::Box& box, unsigned bits) {
  core::Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = ((bits >> k) & 1U) != 0 ? box.max[k] : box.min[k];
  return reports::plots::project(p, kPictureView);
}

// The corners of each visible face, and of the outline around all three faces.
constexpr std::array<unsigned, 4> kRight{1, 3, 7, 5};
constexpr std::array<unsigned, 4> kTop{2, 6, 7, 3};
constexpr std::array<unsigned, 6> kOutline{0, 1, 5, 4, 6, 2};
constexpr std::array<unsigned, 6> kSilhouette{4, 5, 1, 3, 2, 6};
constexpr std::array<unsigned, 4> kFloor{0, 1, 5, 4};

template <std::size_t N>
std::string ring(const core::Box& box, const std::array<unsigned, N>& corners, const PicturePlane& plane,
                 double panel_left) {
  std::string data;
  for (const unsigned c : corners) {
    const Point p = plane.at(corner(box, c), panel_left);
    data += (data.empty() ? "M" : "L") + pixels(p.x) + " " + pixels(p.y);
  }
  return data + "Z";
}

// The bodies of each panel as they are drawn: as boxes where bodies translate, else with their shapes.
struct PanelBodies {
  std::vector<std::vector<core::Box>> boxes;
  std::vector<SeenShape> shapes;
  std::vector<std::vector<SeenBody>> turned;

  PanelBodies(const core::Scene& scene, std::span<const ScenePanel> panels) : boxes(panels.size()) {
    if (scene.motion == core::Motion::kRigid)
      take_turned(scene, panels);
    else
      take_boxes(scene, panels);
  }

  void take_boxes(const core::Scene& scene, std::span<const ScenePanel> panels) {
    const core::ShapeTable table = core::build_shapes(scene);
    for (std::size_t p = 0; p < panels.size(); ++p)
      for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        boxes[p].push_back(
            core::translated(table.shapes[table.shape_of_body[b]].octree.boxes[0], panels[p].positions[b]));
  }

  void take_turned(const core::Scene& scene, std::span<const ScenePanel> panels) {
    shapes = seen_shapes(scene);
    turned.resize(panels.size());
    for (std::size_t p = 0; p < panels.size(); ++p)
      for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        turned[p].emplace_back(shapes[scene.bodies[b].mesh], panels[p].positions[b], panels[p].orientations[b]);
        boxes[p].push_back(turned[p].back().box);
      }
  }

  [[nodiscard]] core::Box around() const {
    core::Box all = core::empty_box();
    for (const auto& panel : boxes)
      for (const core::Box& b : panel) all = core::grown(core::grown(all, b.min), b.max);
    return all;
  }
};

// The part of the domain that is drawn: all of it where the bodies fill it, else the floor under them.
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

PicturePlane plane_for(const core::Box& shown) {
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

void draw_ground(reports::plots::Drawing& drawing, const core::Box& domain, const PicturePlane& plane, double left) {
  drawing.path("grid", "", ring(domain, kFloor, plane, left) + ring(domain, kOutline, plane, left));
}

void draw_boxes(reports::plots::Drawing& drawing, const core::Scene& scene, const std::vector<core::Box>& boxes,
                const PicturePlane& plane, double left) {
  std::vector<std::size_t> order;
  std::string outlines;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (scene.bodies[b].inverse_mass > 0.0F)
      order.push_back(b);
    else
      outlines += ring(boxes[b], kSilhouette, plane, left);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
    const double nearer_p = reports::plots::project(core::center(boxes[p]), kPictureView).toward_eye;
    const double nearer_q = reports::plots::project(core::center(boxes[q]), kPictureView).toward_eye;
    return nearer_p != nearer_q ? nearer_p < nearer_q : p < q;
  });
  for (const std::size_t b : order) {
    drawing.path("s" + std::to_string(b % 8), "", ring(boxes[b], kSilhouette, plane, left));
    drawing.path("", "#0004", ring(boxes[b], kRight, plane, left));
    drawing.path("", "#fff4", ring(boxes[b], kTop, plane, left));
  }
  if (!outlines.empty()) drawing.path("frame", "", outlines);
}

}  // namespace

std::string scene_svg(const core::Scene& scene, std::span<const ScenePanel> panels) {
  const PanelBodies bodies(scene, panels);
  const core::Box around = bodies.around();
  const core::Box domain = core::is_empty(around) ? scene.domain : drawn_domain(scene, around);
  const PicturePlane plane = plane_for(domain);
  const double width = kPanel * static_cast<double>(panels.size());
  const bool turn = scene.motion == core::Motion::kRigid;
  reports::plots::Drawing drawing(
      width, kHead + kPanel, scene.name,
      scene.description + (turn ? ". Bodies turn, and are drawn as they lie, static ones as outlines."
                                : ". Bodies are drawn as their boxes, static ones as outlines."));
  drawing.text("heading", {kEdge, 17.0}, reports::plots::Anchor::kStart, scene.name);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double left = kPanel * static_cast<double>(p);
    drawing.text("tick", {left + kEdge, 34.0}, reports::plots::Anchor::kStart, panels[p].caption);
    draw_ground(drawing, domain, plane, left);
    if (turn)
      draw_turned(drawing, scene, bodies.turned[p], plane, left);
    else
      draw_boxes(drawing, scene, bodies.boxes[p], plane, left);
  }
  return drawing.finish(reports::plots::Placement::kFile);
}

}  // namespace broadside::bench
