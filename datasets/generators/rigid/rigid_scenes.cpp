#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {

std::span<const SmallSceneRow> rigid_scenes() {
  static const std::vector<SmallSceneRow> kAll = [] {
    std::vector<SmallSceneRow> all;
#define RIGID_SCENES(function) \
  for (const SmallSceneRow& row : function()) all.push_back(row);
#include "datasets/generators/rigid/rigid_scenes.inc"
#undef RIGID_SCENES
    return all;
  }();
  return kAll;
}

}  // namespace broadside::datasets
