// The spatial hash behind core's interface: `hash-cpu`, and `make_broad_phase` of the pipeline.
#pragma once

#include <memory>

#include "core/engine/broad_phase.hpp"

namespace broadside::reference {

// cell_m > 0. threads: 0 = work in the caller's oneTBB arena (all cores where there is none); otherwise in an arena of
// its own with that many. The pairs are the same bits either way. Boxes that are not finite, or have min > max, are
// refused at load.
std::unique_ptr<core::BroadPhase> make_hash_broad_phase(float cell_m, int threads = 0);

}  // namespace broadside::reference
