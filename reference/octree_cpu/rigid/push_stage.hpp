// How far bodies may push each other in the next step: core/method/rigid/pushed_motion.hpp.
#pragma once

#include <span>

#include "core/pair.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::reference {

// Notes in bodies.push how far the two bodies of a candidate pair may push each other. May be called from any thread.
void note_pushes(core::RigidBodies& bodies, core::Pair pair);

// Call after note_pushes of all candidates. Notes in bodies.passed_on the pushes that confirmed pairs pass on.
void pass_on_pushes(core::RigidBodies& bodies, std::span<const core::Pair> confirmed);

}  // namespace broadside::reference
