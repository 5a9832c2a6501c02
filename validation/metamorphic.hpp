// metamorphic: a transformed scene has the transformed outcome.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law: against a run of one engine and settings on a transformed scene (core/scene/transformed_scene.hpp),
//   - scaled by a power of two, mirrored on an axis: every state, box, pair, proximity and contact is the transformed
//     one, to the last bit (a zero's sign aside);
//   - renumbered, which swaps A and B of pairs: equal detection states give the renumbered pairs; the renumbered
//     contact of any two bodies that meet no third body in either run; and the renumbered face contacts of these bodies
//     and of bodies that meet no other. The order in which a body's several contacts are applied is a function of ids
//     (METHOD leaves it open), so trajectories may differ from the first frame with such a body on;
//   - grown: where bodies stand at the same places, the candidate pairs contain the subject's.
// Mirroring moves vertices on an octant's plane to the other octant, so where last-level boxes decide, confirmed pairs
// may differ; nothing is compared from such a frame on. A contact whose centers coincide on its axis has no side that
// mirroring or renumbering could change, and is left undecided.
//
// Limits: 0. Rounding is symmetric in sign, and a power of two only shifts exponents.
ValidatorRow metamorphic_row();

}  // namespace broadside::validation
