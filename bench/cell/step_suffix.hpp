// "rigid:bounce@1/240": a scene with another step of the same duration, for runs that compare steps.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// The text before the last '@', and the step after it, in s: "1/240" or "0.004". Where no number follows the '@', the
// whole text and no step, so that a file name may contain an '@'.
std::pair<std::string_view, std::optional<double>> split_step(std::string_view spec);

// The same duration in steps of dt_s, rounded to whole frames. Errors: a step that is not above zero, too many frames.
core::Result<core::Scene> scene_at_step(core::Scene scene, double dt_s);

}  // namespace broadside::bench
