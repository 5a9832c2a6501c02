// The equivalence card of a cell: what the engine says about itself, and what holds for every engine of this program.
#pragma once

#include "core/engine/engine.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

core::EquivalenceCard equivalence_of(const core::Engine& engine, const core::Scene& scene);

}  // namespace broadside::bench
