// Where to start shrinking when a trace already shows the fault.
#pragma once

#include <optional>
#include <string>

#include "bench/shrink/shrink_scene.hpp"
#include "bench/shrink/trial.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// The trace's scene, with its bodies in the states recorded just before the worst place that the validator finds, and
// with one frame to run; this saves running up to there. None when the engine does not get the verdict from there, or
// the trace does not record those states. Errors: an unreadable trace, an unknown validator.
core::Result<std::optional<core::Scene>> start_before_fault(const std::string& trace, const Question& question,
                                                            const Oracle& oracle);

}  // namespace broadside::bench
