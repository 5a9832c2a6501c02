#include "datasets/generators/scene_families.hpp"

#include <array>

namespace broadside::datasets {

std::span<const SceneFamily> scene_families() {
  static const std::array<SceneFamily, 12> kFamilies{freefall_family(),    random_move_family(), tower_family(),
                                                     pyramid_family(),     domino_family(),      wall_family(),
                                                     drum_family(),        funnel_family(),      hopper_family(),
                                                     mixed_sizes_family(), same_point_family(),  static_family()};
  return kFamilies;
}

const SceneFamily* find_family(std::string_view name) {
  for (const SceneFamily& family : scene_families())
    if (family.name == name) return &family;
  return nullptr;
}

}  // namespace broadside::datasets
