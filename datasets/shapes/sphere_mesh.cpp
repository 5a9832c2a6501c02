#include "datasets/shapes/sphere_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

using core::Mesh;

struct Point {
  double x, y, z;
};

Point operator*(double s, Point p) {
  return {s * p.x, s * p.y, s * p.z};
}
Point operator+(Point p, Point q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}
double dot(Point p, Point q) {
  return (p.x * q.x + p.y * q.y) + p.z * q.z;
}

// The icosahedron's corners are the cyclic permutations of (0, +-1, +-golden ratio); its triangles face outward.
constexpr int kCorners = 12;
constexpr int kFaces = 20;
constexpr std::array<std::array<int, 3>, kFaces> kFaceCorners{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

std::array<Point, kCorners> corners() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}}};
}

// Numbers the lattice points so that faces share the points on their edges, and stores each point's direction.
class GeodesicLattice {
 public:
  explicit GeodesicLattice(int frequency) : f_(frequency), corner_(corners()) {
    for (const Point& c : corner_) add(c);
    for (int face = 0; face < kFaces; ++face) cut(kFaceCorners[face]);
  }

  [[nodiscard]] const std::vector<Point>& directions() const { return directions_; }
  std::vector<core::Triangle> take_triangles() { return std::move(triangles_); }

 private:
  std::uint32_t add(Point p) {
    directions_.push_back((1.0 / std::sqrt(dot(p, p))) * p);
    return static_cast<std::uint32_t>(directions_.size() - 1);
  }

  // The point k / f of the way from corner a to corner b.
  std::uint32_t on_edge(int a, int b, int k) {
    if (k == 0) return static_cast<std::uint32_t>(a);
    if (k == f_) return static_cast<std::uint32_t>(b);
    if (a > b) std::swap(a, b), k = f_ - k;
    const auto [entry, is_new] = edge_begin_.try_emplace({a, b}, static_cast<std::uint32_t>(directions_.size()));
    if (is_new)
      for (int m = 1; m < f_; ++m) add(double(f_ - m) * corner_[a] + double(m) * corner_[b]);
    return entry->second + static_cast<std::uint32_t>(k - 1);
  }

  void cut(const std::array<int, 3>& face) {
    const auto [a, b, c] = face;
    // Row r runs from edge ab to edge ac and has r + 1 points.
    std::vector<std::uint32_t> above{on_edge(a, b, 0)};
    for (int r = 1; r <= f_; ++r) {
      std::vector<std::uint32_t> row(r + 1);
      for (int s = 0; s <= r; ++s) {
        if (s == 0)
          row[s] = on_edge(a, b, r);
        else if (s == r)
          row[s] = on_edge(a, c, r);
        else if (r == f_)
          row[s] = on_edge(b, c, s);
        else
          row[s] = add(double(f_ - r) * corner_[a] + (double(r - s) * corner_[b] + double(s) * corner_[c]));
      }
      for (int s = 0; s < r; ++s) {
        triangles_.push_back({above[s], row[s], row[s + 1]});
        if (s + 1 < r) triangles_.push_back({above[s], row[s + 1], above[s + 1]});
      }
      above = std::move(row);
    }
  }

  int f_;
  std::array<Point, kCorners> corner_;
  std::map<std::pair<int, int>, std::uint32_t> edge_begin_;
  std::vector<Point> directions_;
  std::vector<core::Triangle> triangles_;
};

constexpr int kMaxFrequency = 1024;

template <typename Radius>
Mesh blown_up(int frequency, Radius radius_m) {
  GeodesicLattice lattice(frequency);
  Mesh mesh;
  mesh.vertices.reserve(lattice.directions().size());
  for (const Point d : lattice.directions()) {
    const Point p = radius_m(d) * d;
    mesh.vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  mesh.triangles = lattice.take_triangles();
  return mesh;
}

}  // namespace

core::Result<core::Mesh> sphere_mesh(double radius_m, int frequency) {
  if (!(std::isfinite(radius_m) && radius_m > 0.0))
    return core::Error{"the radius is zero, negative or not finite", "sphere mesh", "give a radius above zero, in m"};
  if (frequency < 1 || frequency > kMaxFrequency)
    return core::Error{"edges are cut into " + std::to_string(frequency) + " parts", "sphere mesh", "give 1 to 1024"};
  Mesh mesh = blown_up(frequency, [&](Point) { return radius_m; });
  mesh.name = "sphere";
  mesh.source = "procedural: icosphere of frequency " + std::to_string(frequency);
  return mesh;
}

core::Result<core::Mesh> lumpy_mesh(std::uint64_t triangles, std::uint64_t seed) {
  constexpr std::uint64_t kMost = 20ULL * kMaxFrequency * kMaxFrequency;
  if (triangles < 20 || triangles > kMost)
    return core::Error{"it asks for " + std::to_string(triangles) + " triangles", "lumpy mesh",
                       "give 20 to " + std::to_string(kMost)};
  const int frequency =
      std::clamp(static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 20.0))), 1, kMaxFrequency);

  struct Lump {
    RandomStream::Direction at;
    double height;
  };
  // A dozen lumps of half a radian or so make a body with concavities on the scale of a bunny's head; the lowest radius
  // stays 1 because no lump is negative.
  RandomStream random(seed);
  std::vector<Lump> lumps;
  for (int k = 0; k < 12; ++k) {
    const auto at = random.direction();
    lumps.push_back({at, random.between(0.15, 0.6)});
  }
  Mesh mesh = blown_up(frequency, [&](Point d) {
    double radius = 1.0;
    for (const Lump& lump : lumps) {
      const double cosine = std::max(0.0, dot(d, {lump.at.x, lump.at.y, lump.at.z}));
      const double squared = cosine * cosine;
      const double eighth = (squared * squared) * (squared * squared);
      radius += lump.height * eighth;
    }
    return radius;
  });
  mesh.name = "lumpy";
  mesh.source = "procedural: lumpy sphere of frequency " + std::to_string(frequency) + ", seed " + std::to_string(seed);
  return mesh;
}

}  // namespace broadside::datasets
