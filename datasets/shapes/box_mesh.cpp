#include "datasets/shapes/box_mesh.hpp"

#include <cmath>
#include <map>
#include <string>

namespace broadside::datasets {
namespace {

using core::Mesh;
using core::Vec3;
using Lattice = std::array<int, 3>;

class BoxBuilder {
 public:
  BoxBuilder(std::array<double, 3> sides_m, Lattice segments) : sides_(sides_m), segments_(segments) {}

  // The two faces across `axis`, each cell as two triangles that face outward.
  void add_faces(int axis) {
    const int u = (axis + 1) % 3;
    const int w = (axis + 2) % 3;
    for (const bool upper : {false, true})
      for (int i = 0; i < segments_[u]; ++i)
        for (int j = 0; j < segments_[w]; ++j) add_cell(axis, u, w, upper, i, j);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void add_cell(int axis, int u, int w, bool upper, int i, int j) {
    const auto at = [&](int di, int dj) {
      Lattice p{};
      p[axis] = upper ? segments_[axis] : 0;
      p[u] = i + di;
      p[w] = j + dj;
      return vertex(p);
    };
    const std::uint32_t a = at(0, 0);
    const std::uint32_t b = at(1, 0);
    const std::uint32_t c = at(1, 1);
    const std::uint32_t d = at(0, 1);
    // u x w = +axis, so a b c d runs counterclockwise seen from outside the upper face.
    if (upper) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    } else {
      mesh_.triangles.push_back({a, c, b});
      mesh_.triangles.push_back({a, d, c});
    }
  }

  std::uint32_t vertex(Lattice p) {
    const auto [entry, is_new] = index_.try_emplace(p, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      Vec3 v;
      for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(sides_[k] * (double(p[k]) / segments_[k] - 0.5));
      mesh_.vertices.push_back(v);
    }
    return entry->second;
  }

  std::array<double, 3> sides_;
  Lattice segments_;
  std::map<Lattice, std::uint32_t> index_;
  Mesh mesh_;
};

}  // namespace

core::Result<core::Mesh> box_mesh(std::array<double, 3> sides_m, std::array<int, 3> segments) {
  for (int k = 0; k < 3; ++k) {
    if (!(std::isfinite(sides_m[k]) && sides_m[k] > 0.0))
      return core::Error{"a side is zero, negative or not finite", "box mesh", "give three lengths above zero, in m"};
    if (segments[k] < 1 || segments[k] > 1024)
      return core::Error{"a side is cut into " + std::to_string(segments[k]) + " segments", "box mesh",
                         "give 1 to 1024 per axis"};
  }
  BoxBuilder builder(sides_m, segments);
  for (int axis = 0; axis < 3; ++axis) builder.add_faces(axis);
  Mesh mesh = builder.take();
  mesh.name = "box";
  mesh.source = "procedural: box cut " + std::to_string(segments[0]) + " x " + std::to_string(segments[1]) + " x " +
                std::to_string(segments[2]);
  return mesh;
}

}  // namespace broadside::datasets
