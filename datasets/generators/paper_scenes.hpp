// The two scenes of the paper's experiments, with what it leaves open fixed as METHOD section 9 says.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {

// P-Table A1: free-fall stacking. Every body has the mesh at a longest side of 1 m, mass 1 kg, and starts at rest in a
// stacked grid. count = 0 gives an empty scene.
core::Result<core::Scene> freefall_scene(std::string_view mesh, std::uint32_t count, const SceneOptions& options);

// P-Tables 5 and 6: "randomly moving" bodies in a cube without gravity, whose faces bounce fully and do not rub.
core::Result<core::Scene> random_move_scene(std::string_view mesh, std::uint32_t count, const SceneOptions& options);

}  // namespace broadside::datasets
