#include "core/exact/convex_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/exact/triangle_distance.hpp"

namespace broadside::exact {
namespace {

constexpr double kShareOfSize = 0x1p-40;

struct Face {
  std::array<std::uint32_t, 3> corner{};
  std::array<std::uint32_t, 3> beside{};  // face across the edge from corner k to corner k + 1
  Point normal;                           // unit, outward
  double offset = 0.0;
  std::vector<std::uint32_t> outside;  // points in front of this face
  bool is_alive = true;
};

class Quickhull {
 public:
  explicit Quickhull(const std::vector<core::Vec3>& points) : given_(points) {
    for (const core::Vec3 v : points) p_.push_back(to_point(v));
  }

  std::optional<core::Mesh> hull() {
    if (!start()) return std::nullopt;
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      while (faces_[f].is_alive && !faces_[f].outside.empty())
        if (!add_farthest(f)) return std::nullopt;
    core::Mesh mesh;
    mesh.vertices = given_;
    for (const Face& f : faces_)
      if (f.is_alive) mesh.triangles.push_back({f.corner[0], f.corner[1], f.corner[2]});
    return mesh;
  }

 private:
  [[nodiscard]] double height(const Face& f, std::uint32_t i) const { return dot(f.normal, p_[i]) - f.offset; }

  Face face(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    Face f;
    f.corner = {a, b, c};
    const Point n = cross(p_[b] - p_[a], p_[c] - p_[a]);
    const double size = length(n);
    if (size > 0.0) f.normal = (1.0 / size) * n;
    f.offset = dot(f.normal, p_[a]);
    return f;
  }

  template <typename Measure>
  [[nodiscard]] std::uint32_t farthest(const Measure& measure) const {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < p_.size(); ++i)
      if (measure(i) > measure(best)) best = i;
    return best;
  }

  // Starts with four points far from each other, as a tetrahedron whose triangles face outward.
  bool start() {
    if (p_.size() < 4) return false;
    const std::uint32_t a = farthest([&](std::uint32_t i) { return -p_[i].x; });
    const std::uint32_t b = farthest([&](std::uint32_t i) { return length(p_[i] - p_[a]); });
    const double size = length(p_[b] - p_[a]);
    near_ = kShareOfSize * size;
    const std::uint32_t c = farthest([&](std::uint32_t i) { return length(cross(p_[i] - p_[a], p_[b] - p_[a])); });
    const Face base = face(a, b, c);
    const std::uint32_t d = farthest([&](std::uint32_t i) { return std::abs(height(base, i)); });
    if (!(std::abs(height(base, d)) > near_)) return false;
    const bool turns = height(base, d) > 0.0;
    const std::uint32_t v[4] = {a, turns ? c : b, turns ? b : c, d};
    faces_ = {face(v[0], v[1], v[2]), face(v[0], v[3], v[1]), face(v[1], v[3], v[2]), face(v[2], v[3], v[0])};
    faces_[0].beside = {1, 2, 3};
    faces_[1].beside = {3, 2, 0};
    faces_[2].beside = {1, 3, 0};
    faces_[3].beside = {2, 1, 0};
    std::vector<std::uint32_t> all(p_.size());
    for (std::uint32_t i = 0; i < p_.size(); ++i) all[i] = i;
    share_out(all, 0);
    return true;
  }

  // Assigns each point to the first face, from `first` on, that it is in front of; the other points are inside.
  void share_out(const std::vector<std::uint32_t>& points, std::size_t first) {
    for (const std::uint32_t i : points)
      for (std::size_t f = first; f < faces_.size(); ++f)
        if (height(faces_[f], i) > near_) {
          faces_[f].outside.push_back(i);
          break;
        }
  }

  // Replaces the faces that are visible from the farthest point in front of f by a fan from that point to their rim.
  bool add_farthest(std::uint32_t f) {
    const auto& outside = faces_[f].outside;
    const std::uint32_t top = *std::max_element(outside.begin(), outside.end(), [&](std::uint32_t i, std::uint32_t j) {
      return height(faces_[f], i) < height(faces_[f], j);
    });
    std::vector<std::uint32_t> seen{f};
    faces_[f].is_alive = false;
    struct Rim {
      std::uint32_t from, to, beyond;
    };
    std::vector<Rim> rim;
    std::vector<std::uint32_t> orphans;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Face& dead = faces_[seen[k]];
      orphans.insert(orphans.end(), dead.outside.begin(), dead.outside.end());
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t other = dead.beside[e];
        if (!faces_[other].is_alive) continue;
        if (height(faces_[other], top) > near_) {
          faces_[other].is_alive = false;
          seen.push_back(other);
        }
      }
    }
    for (const std::uint32_t s : seen)
      for (std::size_t e = 0; e < 3; ++e)
        if (faces_[faces_[s].beside[e]].is_alive)
          rim.push_back({faces_[s].corner[e], faces_[s].corner[(e + 1) % 3], faces_[s].beside[e]});
    for (const std::uint32_t s : seen) faces_[s].outside = {};
    return add_fan(rim, top) && (share_out(orphans, faces_.size() - rim.size()), true);
  }

  template <typename Rims>
  bool add_fan(const Rims& rim, std::uint32_t top) {
    const auto first = static_cast<std::uint32_t>(faces_.size());
    std::map<std::uint32_t, std::uint32_t> leaving;  // by point: the new face whose rim edge starts there
    for (std::uint32_t k = 0; k < rim.size(); ++k)
      if (!leaving.emplace(rim[k].from, first + k).second) return false;  // the rim is no single loop
    for (const auto& r : rim) {
      const auto next = leaving.find(r.to);
      if (next == leaving.end()) return false;
      Face made = face(r.from, r.to, top);
      made.beside[0] = r.beyond;
      made.beside[1] = next->second;
      faces_.push_back(std::move(made));
      auto& back = faces_[r.beyond];
      for (std::size_t e = 0; e < 3; ++e)
        if (back.corner[e] == r.to && back.corner[(e + 1) % 3] == r.from)
          back.beside[e] = static_cast<std::uint32_t>(faces_.size() - 1);
    }
    for (std::uint32_t k = first; k < faces_.size(); ++k) faces_[faces_[k].beside[1]].beside[2] = k;
    return true;
  }

  const std::vector<core::Vec3>& given_;
  std::vector<Point> p_;
  std::vector<Face> faces_;
  double near_ = 0.0;
};

}  // namespace

std::optional<core::Mesh> convex_hull(const std::vector<core::Vec3>& points) {
  return Quickhull(points).hull();
}

}  // namespace broadside::exact
