#include "bench/cli/paint_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace broadside::bench {
namespace {

using reports::plots::Point;

constexpr auto kCells = static_cast<int>(kPanel);  // rows and columns, one for each pixel

// A body's nearest surface in one pixel.
struct Fragment {
  int cell = 0;
  double toward_eye = 0.0;
  std::size_t body = 0;
};

// Depths of one body, pixel by pixel.
class BodyDepths {
 public:
  BodyDepths(const SeenBody& body, const PicturePlane& plane) : body_(body), plane_(plane) {
    for (const auto& polygon : body.shape->polygons)
      if (body.faces_eye(polygon))
        for (std::size_t k = 2; k < polygon.size(); ++k) cover(polygon[0], polygon[k - 1], polygon[k]);
  }

  void add_to(std::vector<Fragment>& fragments, std::size_t index) const {
    for (const auto& [cell, depth] : depth_) fragments.push_back({cell, depth, index});
  }

 private:
  [[nodiscard]] std::array<double, 3> place(std::uint32_t vertex) const {
    const auto& p = body_.points[vertex];
    return {(p.x - plane_.left) * plane_.scale, (plane_.top - p.y) * plane_.scale, p.toward_eye};
  }

  void cover(std::uint32_t first, std::uint32_t second, std::uint32_t third) {
    const auto a = place(first), b = place(second), c = place(third);
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (area == 0.0) return;
    const auto from = [](double low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5))); };
    const auto to = [](double high) { return std::min(kCells - 1, static_cast<int>(std::floor(high - 0.5))); };
    for (int y = from(std::min({a[1], b[1], c[1]})); y <= to(std::max({a[1], b[1], c[1]})); ++y)
      for (int x = from(std::min({a[0], b[0], c[0]})); x <= to(std::max({a[0], b[0], c[0]})); ++x) {
        const double px = x + 0.5 - a[0], py = y + 0.5 - a[1];
        const double of_b = (px * (c[1] - a[1]) - (c[0] - a[0]) * py) / area;
        const double of_c = ((b[0] - a[0]) * py - px * (b[1] - a[1])) / area;
        if (of_b < 0.0 || of_c < 0.0 || of_b + of_c > 1.0) continue;
        const double depth = a[2] + of_b * (b[2] - a[2]) + of_c * (c[2] - a[2]);
        const auto [at, is_new] = depth_.try_emplace(y * kCells + x, depth);
        if (!is_new) at->second = std::max(at->second, depth);
      }
  }

  const SeenBody& body_;
  const PicturePlane& plane_;
  std::map<int, double> depth_;
};

// For each body, the bodies that it hides: neighbors in depth, of which it is in front in most common pixels.
std::vector<std::vector<std::size_t>> hidden_by(std::span<const SeenBody> bodies, const PicturePlane& plane) {
  std::vector<Fragment> fragments;
  for (std::size_t b = 0; b < bodies.size(); ++b) BodyDepths(bodies[b], plane).add_to(fragments, b);
  std::sort(fragments.begin(), fragments.end(), [](const Fragment& a, const Fragment& b) {
    return a.cell != b.cell               ? a.cell < b.cell
           : a.toward_eye != b.toward_eye ? a.toward_eye < b.toward_eye
                                          : a.body < b.body;
  });
  std::map<std::pair<std::size_t, std::size_t>, int> pixels_in_front;  // where the second is in front, less the rest
  for (std::size_t k = 1; k < fragments.size(); ++k) {
    const Fragment &behind = fragments[k - 1], &before = fragments[k];
    if (behind.cell != before.cell) continue;
    pixels_in_front[std::minmax(behind.body, before.body)] += behind.body < before.body ? 1 : -1;
  }
  std::vector<std::vector<std::size_t>> hidden(bodies.size());
  for (const auto& [pair, pixels] : pixels_in_front) {
    if (pixels > 0) hidden[pair.second].push_back(pair.first);
    if (pixels < 0) hidden[pair.first].push_back(pair.second);
  }
  return hidden;
}

}  // namespace

std::vector<std::size_t> paint_order(std::span<const SeenBody> bodies, const PicturePlane& plane) {
  const auto hidden = hidden_by(bodies, plane);
  std::vector<std::vector<std::size_t>> hiders(bodies.size());
  std::vector<std::size_t> still_behind(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    still_behind[b] = hidden[b].size();
    for (const std::size_t h : hidden[b]) hiders[h].push_back(b);
  }
  const auto key = [&](std::size_t b) {
    return std::pair(reports::plots::project(core::center(bodies[b].box), kPictureView).toward_eye, b);
  };
  std::set<std::pair<double, std::size_t>> ready, waiting;
  for (std::size_t b = 0; b < bodies.size(); ++b) (still_behind[b] == 0 ? ready : waiting).insert(key(b));
  std::vector<std::size_t> order;
  while (!ready.empty() || !waiting.empty()) {
    auto& from = ready.empty() ? waiting : ready;
    const std::size_t next = from.begin()->second;
    from.erase(from.begin());
    order.push_back(next);
    for (const std::size_t hider : hiders[next])
      if (--still_behind[hider] == 0 && waiting.erase(key(hider)) != 0) ready.insert(key(hider));
  }
  return order;
}

}  // namespace broadside::bench
