// candidate-set: a broad phase returns exactly the overlapping pairs of the boxes it was given.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, P(6): the candidate pairs of a frame are the pairs i < j of recorded boxes that overlap as closed boxes,
// compared as the stored floats, without pairs of two static bodies; sorted, each once. A missed pair fails for every
// engine. A pair too many fails for engines that say they are exact, and is a measured share for the others. The exact
// set is computed by this folder's OverlapJoin, and settles every disagreement. If the baseline has pairs of bit-equal
// boxes, the verdict's sentence also says in how many frames the two lists differ.
//
// Limits: 0 pairs. Nothing rounds: boxes are compared as stored.
ValidatorRow candidate_set_row();

}  // namespace broadside::validation
