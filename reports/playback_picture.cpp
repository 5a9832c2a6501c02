// One frame as an SVG picture; declared in playback.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/playback.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

using core::Vec3;

constexpr double kWidth = 720.0;
constexpr double kHeight = 440.0;
constexpr std::size_t kMostBodies = 400;  // more bodies are a gray heap in a picture of this size

struct Point {
  double x = 0.0, y = 0.0, depth = 0.0;
};

// Parallel projection from above and one side; depth grows towards the eye.
class Projection {
 public:
  explicit Projection(Vec3 up) : up_(up), side_{up.y, up.z, up.x}, front_{} {
    front_ = {up_.y * side_.z - up_.z * side_.y, up_.z * side_.x - up_.x * side_.z, up_.x * side_.y - up_.y * side_.x};
  }
  [[nodiscard]] Point operator()(Vec3 p) const {
    const auto along = [&](Vec3 axis) { return static_cast<double>(core::dot(p, axis)); };
    const double u = along(up_);
    const double s = along(side_);
    const double f = along(front_);
    return {0.94 * s - 0.34 * f, -(0.92 * u - 0.13 * s - 0.37 * f), 0.34 * s + 0.86 * f + 0.39 * u};
  }
  // Whether a side with this outward normal faces the eye.
  [[nodiscard]] bool sees(Vec3 outward) const { return (*this)(outward).depth > 0.0; }

 private:
  Vec3 up_, side_, front_;
};

Vec3 corner(const core::Box& box, unsigned k) {
  return {(k & 1U) != 0 ? box.max.x : box.min.x, (k & 2U) != 0 ? box.max.y : box.min.y,
          (k & 4U) != 0 ? box.max.z : box.min.z};
}

// The box of a body's shape at the body's pose.
struct PlacedBox {
  core::Box box;
  Vec3 position;
  core::Quat turn;

  [[nodiscard]] Vec3 placed(Vec3 p) const { return core::rotate(turn, p) + position; }
  [[nodiscard]] Vec3 corner_at(unsigned k) const { return placed(corner(box, k)); }
  [[nodiscard]] Vec3 middle() const { return placed(0.5F * (box.min + box.max)); }
  [[nodiscard]] Vec3 outward(int axis, bool is_max) const {
    Vec3 normal{};
    normal[axis] = is_max ? 1.0F : -1.0F;
    return core::rotate(turn, normal);
  }
};

std::string fixed(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

// Maps what is shown into the picture.
struct Frame {
  double left = 0.0, top = 0.0, scale = 1.0;
  [[nodiscard]] std::string at(Point p) const { return fixed((p.x - left) * scale) + "," + fixed((p.y - top) * scale); }
};

std::string box_svg(const PlacedBox& box, const Projection& project, const Frame& frame, std::string_view style) {
  std::string sides;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_max : {false, true}) {
      if (!project.sees(box.outward(axis, is_max))) continue;
      const auto bit = 1U << static_cast<unsigned>(axis);
      const auto next = 1U << static_cast<unsigned>((axis + 1) % 3);
      const auto last = 1U << static_cast<unsigned>((axis + 2) % 3);
      const unsigned base = is_max ? bit : 0U;
      std::string corners;
      for (const unsigned k : {base, base | next, base | next | last, base | last})
        corners += (corners.empty() ? "" : " ") + frame.at(project(box.corner_at(k)));
      sides += element("polygon", {{"points", corners}});
    }
  }
  return element("g." + std::string(style), sides);
}

}  // namespace

std::string playback_picture(const Playback& playback, int mark) {
  if (playback.frames.empty()) return "";
  const PlaybackMark* marked = mark >= 0 ? &playback.marks.at(static_cast<std::size_t>(mark)) : nullptr;
  const PlaybackFrame* shown = &playback.frames.back();
  if (marked != nullptr && marked->step >= 0)
    for (const PlaybackFrame& frame : playback.frames)
      if (static_cast<std::int64_t>(frame.step) == marked->step) shown = &frame;

  const Projection project(playback.up);
  struct Item {
    std::uint32_t body;
    PlacedBox box;
    double depth;
    bool is_marked;
  };
  std::vector<Item> items;
  double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
  for (std::uint32_t body = 0; body < shown->position.size(); ++body) {
    const bool is_marked =
        marked != nullptr && std::find(marked->bodies.begin(), marked->bodies.end(), body) != marked->bodies.end();
    if (body >= kMostBodies && !is_marked) continue;
    const PlaybackShape& shape = playback.shapes[playback.shape_of_body[body]];
    if (shape.levels.empty() || shape.levels[0].empty()) continue;
    const core::Quat turn = body < shown->turn.size() ? shown->turn[body] : core::Quat{};
    const PlacedBox box{shape.levels[0][0], shown->position[body], turn};
    const Point middle = project(box.middle());
    if (!std::isfinite(middle.depth)) continue;
    items.push_back({body, box, middle.depth, is_marked});
    for (unsigned k = 0; k < 8; ++k) {
      const Point p = project(box.corner_at(k));
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
  }
  if (items.empty()) return "";
  // Painter's algorithm: far items first, the marked ones last.
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return a.is_marked != b.is_marked ? b.is_marked : a.depth < b.depth;
  });
  const double scale =
      std::min((kWidth - 20) / std::max(right - left, 1e-12), (kHeight - 20) / std::max(bottom - top, 1e-12));
  const Frame frame{left - 10 / scale, top - 10 / scale, scale};

  std::string caption =
      "Step " + counted(shown->step) + " of " + playback.stamp.label() + " on " + playback.stamp.scene_name;
  if (marked != nullptr) caption += "; marked: " + marked->text;
  if (shown->position.size() > kMostBodies)
    caption += "; the first " + counted(kMostBodies) + " bodies and those marked";
  std::string boxes;
  std::string names;
  for (const Item& item : items) {
    boxes += box_svg(item.box, project, frame, item.is_marked ? "body.marked" : "body");
    if (!item.is_marked) continue;
    const Point middle = project(item.box.middle());
    names += element("text",
                     {{"x", fixed((middle.x - frame.left) * scale)},
                      {"y", fixed((middle.y - frame.top) * scale)},
                      {"text-anchor", "middle"}},
                     std::to_string(item.body));
  }
  const std::string size = "0 0 " + fixed(kWidth) + " " + fixed((bottom - top) * scale + 20);
  return element("svg.scene", {{"viewBox", size}, {"role", "img"}, {"aria-label", caption}}, boxes, names) +
         element("p.hint", html(caption), ".");
}

}  // namespace broadside::reports
