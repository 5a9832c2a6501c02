#include <algorithm>
#include <array>
#include <vector>

#include "datasets/motions/motions.hpp"
#include "datasets/random.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::datasets {
namespace {

constexpr std::uint64_t kTrianglesOfBody = 320;
constexpr std::uint64_t kShapeCount = 8;
// At this pitch, bodies of 1 m are apart in any orientation: they measure at most 1 m from side to side in any
// direction.
constexpr double kPitch_m = 1.05;
constexpr double kShrink = 0.35;  // share of the way to the middle of each group of two by two by two places
constexpr double kStray_m = 0.1;
constexpr double kMostTurn = 0.2;  // largest component of the rotation axis times the tangent of half the angle

struct ScaledQuaternion {
  double w, x, y, z;

  // The quaternion need not be a unit: the result is divided by its squared length.
  [[nodiscard]] core::Vec3d turned(core::Vec3d v) const {
    const core::Vec3d q{x, y, z};
    const core::Vec3d t = cross(q, v);
    return v + (2.0 / (w * w + x * x + y * y + z * z)) * (w * t + cross(q, t));
  }
};

core::Vec3 to_float(core::Vec3d p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// Scaled so that no vertex is farther than half a meter from the origin.
std::vector<core::Mesh> shapes(std::uint64_t seed) {
  std::vector<core::Mesh> out;
  for (std::uint64_t k = 0; k < kShapeCount; ++k) {
    core::Mesh mesh = lumpy_mesh(kTrianglesOfBody, core::splitmix64(seed + k)).value();
    double far = 0.0;
    for (const core::Vec3 v : mesh.vertices) far = std::max(far, static_cast<double>(core::length(v)));
    for (core::Vec3& v : mesh.vertices) v = static_cast<float>(0.5 / far) * v;
    out.push_back(std::move(mesh));
  }
  return out;
}

}  // namespace

continuous::MovingSurface moving_heap(std::uint64_t triangles, std::uint64_t seed) {
  const auto bodies = static_cast<std::uint32_t>(std::max<std::uint64_t>(2, triangles / kTrianglesOfBody));
  std::uint32_t side = 1;
  while (static_cast<std::uint64_t>(side) * side * side < bodies) ++side;
  const std::vector<core::Mesh> meshes = shapes(seed);
  RandomStream random(core::splitmix64(seed ^ 0x68656170ULL));
  const auto lot = [&](double most) {
    return core::Vec3d{random.between(-most, most), random.between(-most, most), random.between(-most, most)};
  };
  continuous::MovingSurface heap;
  heap.name = "moving heap";
  heap.parts_meet_themselves = false;
  for (std::uint32_t b = 0; b < bodies; ++b) {
    const core::Mesh& mesh = meshes[b % kShapeCount];
    const std::array<std::uint32_t, 3> at = {b % side, (b / side) % side, b / (side * side)};
    core::Vec3d place;
    core::Vec3d moved;
    for (int k = 0; k < 3; ++k) {
      place[k] = kPitch_m * at[k];
      const auto even = at[k] / 2 * 2;
      const double middle = kPitch_m * (even + 0.5);
      moved[k] = place[k] + kShrink * (middle - place[k]) + random.between(-kStray_m, kStray_m);
    }
    const core::Vec3d axis = lot(1.0);
    const core::Vec3d turn = lot(kMostTurn);
    const ScaledQuaternion first{1.0, axis.x, axis.y, axis.z};
    const ScaledQuaternion then{1.0, turn.x, turn.y, turn.z};
    const auto base = static_cast<std::uint32_t>(heap.start.size());
    for (const core::Vec3 v : mesh.vertices) {
      const core::Vec3d arm = first.turned({v.x, v.y, v.z});
      heap.start.push_back(to_float(place + arm));
      heap.end.push_back(to_float(moved + then.turned(arm)));
    }
    for (const core::Triangle& t : mesh.triangles) {
      heap.triangles.push_back({base + t[0], base + t[1], base + t[2]});
      heap.part.push_back(b);
    }
  }
  return heap;
}

}  // namespace broadside::datasets
