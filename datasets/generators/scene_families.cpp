#include "datasets/generators/scene_families.hpp"

namespace broadside::datasets {

std::span<const SceneFamily> scene_families() {
  static const SceneFamily kFamilies[] = {
#define SCENE_FAMILY(function) function(),
#include "datasets/generators/scene_families.inc"
#undef SCENE_FAMILY
  };
  return kFamilies;
}

const SceneFamily* find_family(std::string_view name) {
  for (const SceneFamily& family : scene_families())
    if (family.name == name) return &family;
  return nullptr;
}

}  // namespace broadside::datasets
