#include "gpu/scene/device_scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/method/levels.hpp"
#include "core/scene/shapes.hpp"
#include "core/scene/springs_of_bodies.hpp"

namespace broadside::gpu {
namespace {

BoxFacts facts_of(const core::Scene& scene) {
  BoxFacts facts;
  facts.count = scene.body_count();
  facts.domain = scene.domain;
  facts.low_corner = scene.domain.min;
  const auto widen = [&facts](core::Vec3 v) {
    for (int axis = 0; axis < 3; ++axis)
      facts.coordinate_range_m = std::max(facts.coordinate_range_m, std::abs(v[axis]));
  };
  widen(scene.domain.min), widen(scene.domain.max);
  for (const core::Body& body : scene.bodies) widen(body.position);
  return facts;
}

// What cells of near vertices must allow for; theta is added for each shape.
NearNeeds needs_of(const core::ShapeTable& table, const BoxFacts& facts) {
  NearNeeds needs;
  for (const core::Shape& shape : table.shapes)
    for (const core::Vec3& v : shape.octree.sorted_vertices)
      for (int axis = 0; axis < 3; ++axis) needs.extent_m = std::max(needs.extent_m, std::abs(v[axis]));
  // A body may leave the domain; if it is farther out than this, trees are descended instead.
  needs.range_m = 2.0F * facts.coordinate_range_m + needs.extent_m;
  return needs;
}

// For each shape the largest theta of any pair that it is in. That is the pair with the coarsest shape, because theta
// grows with the mean edges of both shapes, also after rounding.
std::vector<float> thetas_of(const core::ShapeTable& table, const core::Parameters& parameters) {
  std::vector<float> thetas;
  if (table.shapes.empty()) return thetas;
  const core::Shape& coarsest = *std::ranges::max_element(table.shapes, {}, &core::Shape::mean_edge_m);
  for (const core::Shape& shape : table.shapes) thetas.push_back(core::pair_theta_m(parameters, shape, coarsest));
  return thetas;
}

std::vector<std::uint32_t> bodies_of_shapes(const core::ShapeTable& table) {
  std::vector<std::uint32_t> count(table.shapes.size(), 0);
  for (const std::uint32_t shape : table.shape_of_body) ++count[shape];
  return count;
}

}  // namespace

core::Status DeviceScene::load(const core::Scene& scene, const SceneNeeds& needs) {
  const core::ShapeTable table = core::build_shapes(scene);
  std::vector<PackedBox> octree;
  std::vector<PackedBox> level2;
  std::vector<std::uint32_t> level2_count;
  ShapeTrees trees;
  ShapeCells cells;
  box_facts_ = facts_of(scene);
  NearNeeds near = needs_of(table, box_facts_);
  const std::vector<float> thetas = thetas_of(table, scene.parameters);
  if (!thetas.empty()) near.least_theta_m = *std::ranges::min_element(thetas);
  const std::vector<std::uint32_t> bodies = bodies_of_shapes(table);
  std::vector<std::uint64_t> hash_cells;
  tree_levels_ = 1;
  for (const core::Shape& shape : table.shapes) {
    for (const core::Box& box : shape.octree.boxes) octree.push_back(pack(box));
    const core::NodeBoxes nodes = core::node_boxes(shape.octree);
    for (const core::Box& box : nodes.level2) level2.push_back(pack(box));
    level2_count.push_back(nodes.level2_count);
    append_tree(trees, shape.octree.sorted_vertices, shape.octree.sorted_indices, shape.mean_edge_m);
    tree_levels_ = std::max(tree_levels_, trees.headers.back().top + 1);
    if (bodies[trees.headers.size() - 1] >= needs.least_for_cells) {
      near.theta_m = thetas[trees.headers.size() - 1];
      append_cells(cells, trees, near);
    } else {
      append_no_cells(cells);
    }
    const core::Vec3 side = nodes.root.max - nodes.root.min;
    box_facts_.largest_side_m = std::max({box_facts_.largest_side_m, side.x, side.y, side.z});
    hash_cells.push_back(hash_cells_of(side, needs.hash_cell_m));
  }
  for (const std::uint32_t shape : table.shape_of_body) box_facts_.hash_entries += hash_cells[shape];
  quantize_vertices(cells, trees);
  std::vector<core::Material> material;
  std::vector<core::Quat> orientation;
  for (const core::Body& body : scene.bodies) {
    material.push_back(body.material);
    orientation.push_back(body.orientation);
  }
  BROADSIDE_TRY(octree_.upload(octree, "body octrees"));
  BROADSIDE_TRY(level2_.upload(level2, "body octrees"));
  BROADSIDE_TRY(level2_count_.upload(level2_count, "body octrees"));
  BROADSIDE_TRY(trees_.upload(trees.headers, "vertex trees"));
  BROADSIDE_TRY(tree_nodes_.upload(trees.nodes, "vertex trees"));
  BROADSIDE_TRY(tree_upper_.upload(trees.upper, "vertex trees"));
  const bool are_trees_descended =
      std::ranges::any_of(cells.headers, [](const NearCells& shape) { return shape.count_x == 0; });
  tree_upper_count_ = are_trees_descended ? static_cast<std::uint32_t>(trees.upper.size()) : 0;
  BROADSIDE_TRY(tree_vertices_.upload(trees.vertices, "vertices"));
  BROADSIDE_TRY(near_cells_.upload(cells.headers, "cells of near vertices"));
  BROADSIDE_TRY(near_lower_.upload(cells.lower, "cells of near vertices"));
  BROADSIDE_TRY(near_lists_.upload(cells.lists, "cells of near vertices"));
  BROADSIDE_TRY(near_entries_.upload(cells.entries, "cells of near vertices"));
  BROADSIDE_TRY(quantized_.upload(cells.quantized, "cells of near vertices"));
  shape_count_ = static_cast<std::uint32_t>(table.shapes.size());
  extent_m_ = near.extent_m;
  has_cells_ = !cells.lower.empty();
  BROADSIDE_TRY(shape_of_body_.upload(table.shape_of_body, "bodies"));
  BROADSIDE_TRY(material_.upload(material, "materials"));
  BROADSIDE_TRY(orientation_.upload(orientation, "orientations"));
  return load_springs(scene);
}

core::Status DeviceScene::load_springs(const core::Scene& scene) {
  const core::SpringsOfBodies sorted = core::springs_of_bodies(scene);
  has_springs_ = !sorted.springs.empty();
  if (!has_springs_) return core::Done{};
  BROADSIDE_TRY(springs_.upload(sorted.springs, "springs"));
  return spring_begin_.upload(sorted.begin, "springs");
}

void DeviceScene::fill(FrameView& view) const {
  view.shapes = {shape_count_,          octree_.data(),     level2_.data(),     level2_count_.data(),
                 trees_.data(),         tree_nodes_.data(), tree_upper_.data(), tree_upper_count_,
                 tree_vertices_.data(), near_cells_.data(), near_lower_.data(), near_lists_.data(),
                 near_entries_.data(),  quantized_.data(),  extent_m_};
  view.shape_of_body = shape_of_body_.data();
  view.material = material_.data();
  view.springs = has_springs_ ? springs_.data() : nullptr;
  view.spring_begin = has_springs_ ? spring_begin_.data() : nullptr;
}

std::uint64_t DeviceScene::shape_bytes() const {
  return octree_.bytes() + level2_.bytes() + level2_count_.bytes() + trees_.bytes() + tree_nodes_.bytes() +
         tree_upper_.bytes() + tree_vertices_.bytes() + near_cells_.bytes() + near_lower_.bytes() +
         near_lists_.bytes() + near_entries_.bytes() + quantized_.bytes();
}

std::uint64_t DeviceScene::body_bytes() const {
  return shape_of_body_.bytes() + material_.bytes() + orientation_.bytes() + springs_.bytes() + spring_begin_.bytes();
}

}  // namespace broadside::gpu
