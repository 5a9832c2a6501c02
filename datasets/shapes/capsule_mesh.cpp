#include "datasets/shapes/capsule_mesh.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>

namespace broadside::datasets {
namespace {

// Lattice points of the octahedron |i| + |j| + |k| = f; each cap has its own copy of the rim k = 0.
class CapsuleBuilder {
 public:
  CapsuleBuilder(double radius_m, double half_length_m, int frequency)
      : radius_(radius_m), half_length_(half_length_m), f_(frequency) {}

  core::Mesh take() {
    for (const int up : {1, -1})
      for (const int sx : {1, -1})
        for (const int sy : {1, -1}) add_octant(sx, sy, up);
    for (const int sx : {1, -1})
      for (const int sy : {1, -1}) add_side(sx, sy);
    mesh_.name = "capsule";
    mesh_.source = "procedural";
    return std::move(mesh_);
  }

 private:
  std::uint32_t vertex(int i, int j, int k, int up) {
    const auto [entry, is_new] = index_.try_emplace({i, j, k, up}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      const double scale =
          radius_ / std::sqrt(static_cast<double>(i) * i + static_cast<double>(j) * j + static_cast<double>(k) * k);
      mesh_.vertices.push_back({static_cast<float>(scale * i), static_cast<float>(scale * j),
                                static_cast<float>(scale * k + up * half_length_)});
    }
    return entry->second;
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool turns) {
    mesh_.triangles.push_back(turns ? core::Triangle{a, c, b} : core::Triangle{a, b, c});
  }

  // i and j are distances from the pole along the two signed axes; k is the remainder.
  void add_octant(int sx, int sy, int up) {
    const bool turns = sx * sy * up < 0;
    const auto at = [&](int i, int j) { return vertex(sx * i, sy * j, up * (f_ - i - j), up); };
    for (int i = 0; i < f_; ++i) {
      for (int j = 0; i + j < f_; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1), turns);
        if (i + j + 1 < f_) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), turns);
      }
    }
  }

  void add_side(int sx, int sy) {
    const bool turns = sx * sy < 0;
    for (int i = 0; i < f_; ++i) {
      const auto at = [&](int along, int up) { return vertex(sx * along, sy * (f_ - along), 0, up); };
      add(at(i + 1, 1), at(i + 1, -1), at(i, -1), turns);
      add(at(i + 1, 1), at(i, -1), at(i, 1), turns);
    }
  }

  double radius_;
  double half_length_;
  int f_;
  core::Mesh mesh_;
  std::map<std::tuple<int, int, int, int>, std::uint32_t> index_;
};

}  // namespace

core::Result<core::Mesh> capsule_mesh(double radius_m, double half_length_m, int frequency) {
  if (!(radius_m > 0.0) || !std::isfinite(radius_m) || !(half_length_m > 0.0) || !std::isfinite(half_length_m))
    return core::Error{"radius and half length must be finite and above 0", "capsule"};
  if (frequency < 2 || frequency > 512)
    return core::Error{"frequency is " + std::to_string(frequency), "capsule", "give 2 to 512"};
  return CapsuleBuilder(radius_m, half_length_m, frequency).take();
}

}  // namespace broadside::datasets
