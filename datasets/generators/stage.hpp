// A scene under construction: bodies of one model, and static boxes around them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>

#include "core/scene/scene.hpp"
#include "datasets/generators/scene_family.hpp"

namespace broadside::datasets {

using Triple = std::array<double, 3>;

// Lengths in m, velocities in m/s, y upward; gravity is standard unless told otherwise.
class Stage {
 public:
  // The model becomes mesh 0.
  explicit Stage(const GivenScene& given);

  // The longest side of the model's box.
  [[nodiscard]] double longest() const { return longest_; }
  [[nodiscard]] const Triple& sides() const { return sides_; }

  // `center`: of the mesh's box. Mass 0 means a static body.
  void add_body(const Triple& center, const Triple& velocity = {}, double mass_kg = 1.0, std::uint32_t mesh = 0);
  std::uint32_t add_mesh(std::shared_ptr<const core::Mesh> mesh);

  // The box's faces are cut so finely that vertex proximity finds contacts anywhere on them: cuts of an eighth of the
  // model's longest side, and theta at least the mean edge of such a lattice (1.14 cuts, while no point of the face is
  // farther than 0.71 cuts from a vertex). Boxes with equal sides share a mesh.
  void add_static_box(const Triple& low, const Triple& high);

  core::Scene& scene() { return scene_; }
  // Returns the scene with this domain.
  core::Scene finish(const Triple& low, const Triple& high) &&;

 private:
  core::Scene scene_;
  Triple sides_{};
  double longest_ = 0.0;
  std::map<Triple, std::uint32_t> box_meshes_;  // by sides
};

}  // namespace broadside::datasets
