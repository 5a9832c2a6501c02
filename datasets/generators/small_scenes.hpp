// Scenes of a few bodies, each with one purpose: one per erratum of METHOD section 10, and pairs with closed-form
// answers.
#pragma once

#include <span>
#include <string_view>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {

struct SmallSceneRow {
  std::string_view name;  // "errata:E3"
  std::string_view what;
  core::Scene (*make)();
};

// The table of these scenes. Only SceneOptions::frames and seed apply; the scenes need no mesh file and draw nothing at
// random.
std::span<const SmallSceneRow> small_scenes();

}  // namespace broadside::datasets
