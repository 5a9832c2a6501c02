// frame-digest: the recorded digest of a frame is that of the recorded frame.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, core/trace/SCHEMA.md ("The digest"): a frame's digest is the sum modulo 2^64 of one hash per body, confirmed
// pair and contact; where the trace has no bodies, of one per measured separation, and without those of one per
// candidate pair. It is computed anew from the definition on that page, with code of its own.
//
// `/provenance/notes@digest` may say "none": then every digest is 0. Any other text there says that the engine has a
// digest of its own, which is not judged.
//
// Limit: 0 frames; bits are compared.
ValidatorRow frame_digest_row();

}  // namespace broadside::validation
