// Shapes that a narrow-phase adapter prepares once per mesh and orientation: a body that only translates keeps its
// shape.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/engine/narrow_phase.hpp"

namespace broadside::reference {

template <typename Shape>
class TurnedShapes {
 public:
  using Make = std::function<std::unique_ptr<Shape>(const core::Mesh&, core::Quat)>;

  explicit TurnedShapes(Make make) : make_(std::move(make)) {}

  // Removes the earlier shapes, and makes the shape of every body as the scene has it.
  void load(const core::Scene& scene) {
    meshes_ = scene.meshes;
    made_.clear();
    mesh_of_body_.clear();
    for (const core::Body& body : scene.bodies) {
      mesh_of_body_.push_back(body.mesh);
      shape_of(body.mesh, body.orientation);
    }
  }

  [[nodiscard]] std::size_t body_count() const { return mesh_of_body_.size(); }

  // The shape of each body that is in a pair, by body; null for the others. A body that turned since load gets a new
  // shape. Do not call it from several threads at once.
  std::vector<const Shape*> of(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) {
    std::vector<const Shape*> shapes(poses.size(), nullptr);
    for (const core::Pair p : pairs)
      for (const std::uint32_t body : {p.i, p.j})
        if (shapes[body] == nullptr) shapes[body] = &shape_of(mesh_of_body_[body], poses[body].orientation);
    return shapes;
  }

 private:
  const Shape& shape_of(std::uint32_t mesh, core::Quat q) {
    auto& shape = made_[{mesh, q.w, q.x, q.y, q.z}];
    if (shape == nullptr) shape = make_(*meshes_[mesh], q);
    return *shape;
  }

  Make make_;
  std::vector<std::shared_ptr<const core::Mesh>> meshes_;
  std::vector<std::uint32_t> mesh_of_body_;
  std::map<std::tuple<std::uint32_t, float, float, float, float>, std::unique_ptr<Shape>> made_;
};

// The tight box of a mesh's vertices turned in float as the pipeline turns them, before the move to a position.
inline core::Box turned_bounds(const core::Mesh& mesh, core::Quat orientation) {
  core::Box box = core::empty_box();
  for (const core::Vec3 v : mesh.vertices) box = core::grown(box, core::rotate(orientation, v));
  return box;
}

}  // namespace broadside::reference
