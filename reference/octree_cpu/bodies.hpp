// The pipeline's working set on the CPU: one entry per body, and the data that bodies of one shape share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact.hpp"
#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/method/levels.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/shapes.hpp"
#include "reference/octree_cpu/vertex_blocks.hpp"

namespace broadside::reference {

struct ShapeData {
  core::Shape shape;
  core::NodeBoxes boxes;
  VertexBlocks blocks;
};

struct Bodies {
  std::vector<core::Kinematics> state;
  std::vector<float> inverse_mass;
  std::vector<core::Material> material;
  std::vector<std::uint8_t> is_static;
  std::vector<std::uint32_t> shape;
  std::vector<ShapeData> shapes;
  // Springs by body, in the scene's order for each: those of body i are springs[spring_begin[i] .. spring_begin[i+1]).
  // Both are empty when the scene has none.
  std::vector<core::Spring> springs;
  std::vector<std::uint32_t> spring_begin;
  // Boxes at detection, and the states they were made from.
  std::vector<core::Box> boxes;
  std::vector<core::Kinematics> detected;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(state.size()); }
  [[nodiscard]] std::span<const core::Spring> springs_of(std::uint32_t body) const {
    if (springs.empty()) return {};
    return std::span(springs).subspan(spring_begin[body], spring_begin[body + 1] - spring_begin[body]);
  }
  [[nodiscard]] const core::Box& local_box(std::uint32_t body) const { return shapes[shape[body]].boxes.root; }
};

Bodies make_bodies(const core::Scene& scene);

}  // namespace broadside::reference
