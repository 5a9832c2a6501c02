// A body that turns, projected into the picture of a scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/scene.hpp"
#include "reports/plots/model_picture.hpp"

namespace broadside::bench {

// The polygons of a mesh that are drawn, in body coordinates. A face of a convex mesh is one polygon, or a few if it
// has many corners; another mesh keeps its triangles.
struct SeenShape {
  bool is_convex = false;
  std::vector<core::Vec3> vertices;
  std::vector<std::vector<std::uint32_t>> polygons;  // anticlockwise seen from outside
  std::vector<std::uint32_t> plane_of;               // by polygon, of a convex mesh: one number for all of a face
};

// One for each mesh of the scene.
std::vector<SeenShape> seen_shapes(const core::Scene& scene);

// A shape at a pose. `shape` points to an object that the caller keeps.
struct SeenBody {
  const SeenShape* shape = nullptr;
  std::vector<core::Vec3> vertices;               // in the world, m
  std::vector<reports::plots::Projected> points;  // the same in the picture's plane
  core::Box box;                                  // around the vertices

  SeenBody(const SeenShape& of, core::Vec3 position, core::Quat orientation);

  [[nodiscard]] bool faces_eye(std::span<const std::uint32_t> polygon) const;
};

// The corners of the convex outline of these points in the plane, anticlockwise, y upward.
std::vector<reports::plots::Projected> outline_of(std::vector<reports::plots::Projected> points);

}  // namespace broadside::bench
