#include "core/scene/hull_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/exact/triangle_distance.hpp"
#include "core/method/rigid/hull_climb.hpp"

namespace broadside::core {
namespace {

using exact::Point;

// Corners of one face, and the corners that define its plane, are each off by one rounding: together 8 of 2^-24 of the
// size.
constexpr double kInPlane = 8.0 * 0x1p-24;

using Loop = std::vector<std::uint32_t>;

class Faces {
 public:
  explicit Faces(const Mesh& mesh) : mesh_(mesh), group_(mesh.triangles.size(), kNone) {
    const Box b = bounds(mesh);
    near_ = kInPlane * length(exact::to_point(b.max) - exact::to_point(b.min));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) beside_[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
  }

  // Starts with the largest triangles, because their planes are the most accurate.
  HullTables tables() {
    std::vector<std::uint32_t> order(mesh_.triangles.size());
    std::vector<double> area(order.size());
    for (std::uint32_t t = 0; t < order.size(); ++t) {
      order[t] = t;
      area[t] = length(across(t));
    }
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return area[p] > area[q]; });
    for (const std::uint32_t t : order)
      if (group_[t] == kNone && area[t] > 0.0) add_face(t);
    add_edges();
    add_ways();
    add_beyond();
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  [[nodiscard]] Point at(std::uint32_t v) const { return exact::to_point(mesh_.vertices[v]); }
  [[nodiscard]] Point across(std::uint32_t t) const {
    const Triangle& c = mesh_.triangles[t];
    return cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
  }
  [[nodiscard]] std::uint32_t beyond(std::uint32_t t, std::size_t k) const {
    const Triangle& c = mesh_.triangles[t];
    const auto found = beside_.find({c[(k + 1) % 3], c[k]});
    return found == beside_.end() ? kNone : found->second;
  }

  void add_face(std::uint32_t seed) {
    const Point n = across(seed);
    const Point normal = (1.0 / length(n)) * n;
    const double offset = dot(normal, at(mesh_.triangles[seed][0]));
    std::vector<std::uint32_t> members{seed};
    group_[seed] = seed;
    for (std::size_t m = 0; m < members.size(); ++m)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = beyond(members[m], k);
        if (other == kNone || group_[other] != kNone) continue;
        const Triangle& c = mesh_.triangles[other];
        const bool lies_in_plane = std::all_of(
            c.begin(), c.end(), [&](std::uint32_t v) { return std::abs(dot(normal, at(v)) - offset) <= near_; });
        if (!lies_in_plane) continue;
        group_[other] = seed;
        members.push_back(other);
      }
    Loop loop = rim(members, seed);
    if (loop.empty()) {  // the rim is not a single loop: its triangles stay separate faces
      for (const std::uint32_t t : members) add_polygon({mesh_.triangles[t].begin(), mesh_.triangles[t].end()}, normal);
      return;
    }
    while (loop.size() > static_cast<std::size_t>(kFaceCorners)) {
      add_polygon({loop.begin(), loop.begin() + kFaceCorners}, normal);
      loop.erase(loop.begin() + 1, loop.begin() + kFaceCorners - 1);
    }
    add_polygon(loop, normal);
  }

  // The edges of the members that border on other faces, as one loop.
  [[nodiscard]] Loop rim(const std::vector<std::uint32_t>& members, std::uint32_t seed) const {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const std::uint32_t t : members)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = beyond(t, k);
        if (other != kNone && group_[other] == seed) continue;
        if (!next.emplace(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]).second) return {};
      }
    Loop loop;
    if (next.empty()) return loop;
    std::uint32_t v = next.begin()->first;
    for (std::size_t k = 0; k < next.size(); ++k) {
      loop.push_back(v);
      const auto found = next.find(v);
      if (found == next.end()) return {};
      v = found->second;
    }
    if (v != loop.front() || loop.size() != next.size()) return {};
    return loop;
  }

  void add_polygon(const Loop& loop, Point normal) {
    HullFace face;
    face.normal = {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
    face.first_corner = static_cast<std::uint32_t>(out_.corners.size());
    face.corner_count = static_cast<std::uint32_t>(loop.size());
    double highest = -1e300;
    for (const std::uint32_t v : loop) {
      out_.corners.push_back(number_of(v));
      highest = std::max(highest, dot(exact::to_point(face.normal), at(v)));
    }
    face.offset_m = static_cast<float>(highest);
    const auto number = static_cast<std::uint32_t>(out_.faces.size());
    for (std::size_t k = 0; k < loop.size(); ++k)
      sides_[{number_of(loop[k]), number_of(loop[(k + 1) % loop.size()])}] = number;
    out_.faces.push_back(face);
  }

  std::uint32_t number_of(std::uint32_t v) {
    const auto [found, is_new] = numbers_.emplace(v, static_cast<std::uint32_t>(out_.vertices.size()));
    if (is_new) out_.vertices.push_back(mesh_.vertices[v]);
    return found->second;
  }

  void add_edges() {
    for (const auto& [side, face] : sides_) {
      const auto back = sides_.find({side.second, side.first});
      if (back == sides_.end() || side.first < side.second)
        out_.edges.push_back({side.first, side.second, face, back == sides_.end() ? face : back->second});
    }
  }

  void add_ways() {
    std::vector<std::vector<std::uint32_t>> neighbors(out_.vertices.size());
    for (const HullEdge& edge : out_.edges) {
      neighbors[edge.from].push_back(edge.to);
      neighbors[edge.to].push_back(edge.from);
    }
    for (std::uint32_t cell = 0; cell < kGuideStarts; ++cell)
      out_.guide.push_back(lowest_along(middle_of_guide_cell(cell)));
    for (std::uint32_t from = 0; from < neighbors.size(); ++from) {
      out_.guide.push_back(static_cast<std::uint32_t>(out_.ways.size()));
      for (const std::uint32_t to : neighbors[from]) out_.ways.push_back({out_.vertices[to] - out_.vertices[from], to});
    }
    out_.guide.push_back(static_cast<std::uint32_t>(out_.ways.size()));
  }

  [[nodiscard]] std::uint32_t lowest_along(Vec3 direction) const {
    const auto lowest = std::min_element(out_.vertices.begin(), out_.vertices.end(),
                                         [&](Vec3 p, Vec3 q) { return dot(direction, p) < dot(direction, q); });
    return static_cast<std::uint32_t>(lowest - out_.vertices.begin());
  }

  void add_beyond() {
    for (std::uint32_t f = 0; f < out_.faces.size(); ++f) {
      const HullFace& face = out_.faces[f];
      for (std::uint32_t k = 0; k < face.corner_count; ++k) {
        const std::uint32_t from = out_.corners[face.first_corner + k];
        const std::uint32_t to = out_.corners[face.first_corner + (k + 1 == face.corner_count ? 0 : k + 1)];
        const auto back = sides_.find({to, from});
        out_.beyond.push_back(back == sides_.end() ? f : back->second);
      }
    }
  }

  const Mesh& mesh_;
  double near_ = 0.0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> beside_;  // by directed edge: its triangle
  std::vector<std::uint32_t> group_;                                         // by triangle: the seed of its face
  std::map<std::uint32_t, std::uint32_t> numbers_;  // by the mesh's vertices: their numbers in the tables
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> sides_;
  HullTables out_;
};

}  // namespace

HullTables hull_tables(const Mesh& mesh) {
  return Faces(mesh).tables();
}

}  // namespace broadside::core
