// What bodies do to each other in the next step: core/method/rigid/pushed_motion.hpp.
#pragma once

#include <span>

#include "core/pair.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::reference {

// Notes in bodies.push what the two bodies of a candidate pair may do to each other. From any thread.
void note_pushes(core::RigidBodies& bodies, core::Pair pair);

// After all candidates: notes in bodies.passed_on what of that the confirmed pairs pass on.
void pass_on_pushes(core::RigidBodies& bodies, std::span<const core::Pair> confirmed);

}  // namespace broadside::reference
