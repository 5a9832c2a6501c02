// Figure A1: models with the boxes of their octrees, level by level.
#include <fmt/format.h>

#include <memory>

#include "bench/cell/scene_meshes.hpp"
#include "bench/paper/sections.hpp"
#include "core/scene/body_octree.hpp"
#include "reports/plots/model_picture.hpp"

namespace broadside::bench::paper {
namespace {

// The Stanford laboratory asks that demonstration pictures show the Bunny or the Armadillo rather than its Dragon.
const std::vector<std::string> kModels{"bunny", "armadillo", "asian_dragon"};

std::vector<core::Box> boxes_of_level(const core::BodyOctree& octree, std::size_t level) {
  std::vector<core::Box> boxes;
  for (int n = 0; n < core::kLevelSize[level]; ++n) {
    const core::Box& box =
        octree.boxes[static_cast<std::size_t>(core::kLevelOffset[level]) + static_cast<std::size_t>(n)];
    if (!core::is_empty(box)) boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

void add_figure_a1(Document& document, const std::vector<std::string>& models, bool allow_stand_in) {
  document.blocks.emplace_back(Heading{"Figure A1: body octrees, level by level", "figureA1"});
  Notes notes;
  Table table{"figureA1",
              "Boxes of each level; an octant without vertices has none",
              {"model", "vertices", "triangles", "level 0", "level 1", "level 2"},
              {}};
  std::vector<Figure> figures;
  for (const std::string& model : models.empty() ? kModels : models) {
    auto scene = make_scene_with_meshes({"freefall:" + model + ":1", 1, allow_stand_in});
    if (!scene) {
      notes.items.push_back("No picture of " + model + ": " + scene.error().line() + ".");
      continue;
    }
    const core::Mesh& mesh = *scene.value().meshes.front();
    const core::BodyOctree octree = core::build_body_octree(mesh.vertices);
    const auto number = [](std::size_t n) { return TableCell{std::to_string(n), static_cast<double>(n)}; };
    std::vector<TableCell> line{{model}, number(mesh.vertices.size()), number(mesh.triangles.size())};
    for (std::size_t level = 0; level < core::kBodyOctreeLevels; ++level) {
      const std::vector<core::Box> boxes = boxes_of_level(octree, level);
      line.push_back(number(boxes.size()));
      const reports::plots::ModelPicture picture{
          fmt::format("{}, level {}", model, level),
          fmt::format("The model {} in gray with the {} boxes of level {} of its octree in red.", model, boxes.size(),
                      level),
          {}};
      using reports::plots::Placement;
      figures.push_back({fmt::format("figureA1_{}_level{}", model, level), svg(picture, mesh, boxes, Placement::kFile),
                         svg(picture, mesh, boxes, Placement::kInline),
                         fmt::format("{}{}: {} boxes of level {}.", model, mesh.is_stand_in ? " (stand-in)" : "",
                                     boxes.size(), level)});
    }
    table.rows.push_back(std::move(line));
    notes.items.push_back((mesh.is_stand_in ? "Stand-in: " : "") + model + " is " + mesh.source + ".");
  }
  for (Figure& figure : figures) document.blocks.emplace_back(std::move(figure));
  if (!table.rows.empty()) document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(std::move(notes));
}

}  // namespace broadside::bench::paper
