// contact-set: every touching pair has one contact, every body beyond a face has one with that face, and there is no
// other contact.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, METHOD 3 and 4: a confirmed pair with vertices nearer than theta (without the vertex stage: every confirmed
// pair) has one contact, unless the bodies' boxes were apart on an axis when its turn came; a body whose box passes a
// face of the domain when the faces' turn comes has one with that face; no other two bodies have one.
//
// METHOD leaves the order of the body contacts open, so the turn of a contact that is not in the trace is unknown. It
// counts as missing only when the boxes overlap at every moment of the frame: before the first contact of either body,
// and after each color (or, where no colors are told, after each contact). With solver=jacobi the only moment is that
// of detection; with the race of printed-E8 no moment is known, and only superfluous contacts are judged. Faces come
// last and in a given order: the position at a face's turn is that before the body's next face contact, or at the
// frame's end. Where contacts have colors, a color is the length of a chain of touching pairs, so it is below their
// number.
//
// Limits: 0 contacts. Boxes are the shape's box moved to the recorded position in float32, P(5), as recorded boxes are,
// and compared as floats: nothing rounds.
ValidatorRow contact_set_row();

}  // namespace broadside::validation
