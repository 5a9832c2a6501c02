// level-agreement: the level settings of the body octree agree about which pairs they confirm.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, METHOD 2: the pairs confirmed are those whose boxes of the last level (flat: 0, level1: 1, A, B, C: 2) overlap
// somewhere, because a child box lies inside its parent's box. Hence A, B, C confirm the same pairs whatever they start
// from, level1 contains them, and flat contains level1.
//
// Alone: confirmed pairs are recomputed from the body octrees' boxes at the recorded positions. The start is the
// recorded candidates when the engine has a broad phase (so that a pair which the broad phase lost is not counted
// twice), otherwise the exact overlap set. Every frame is judged; a pair that stands still is computed once. With a
// baseline that differs in its level or broad-phase settings only, every frame is compared as long as the recorded
// boxes are bit-equal; once the trajectories differ, because flat confirms other pairs, there is nothing to compare.
//
// Limits: 0 pairs. Boxes are translated in float32 as recorded boxes are, and compared as floats.
ValidatorRow level_agreement_row();

}  // namespace broadside::validation
