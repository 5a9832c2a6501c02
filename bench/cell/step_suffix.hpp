// "rigid:bounce@1/240": a scene with another step of the same duration, for runs that compare steps.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// The text before the last '@' and the step after it, in s: "1/240" or "0.004". The whole text and nothing when no
// number stands there, so that a file name may have an '@'.
std::pair<std::string_view, std::optional<double>> split_step(std::string_view spec);

// The same duration in steps of dt_s, rounded to whole frames. Errors: not a step above zero, too many frames.
core::Result<core::Scene> scene_at_step(core::Scene scene, double dt_s);

}  // namespace broadside::bench
