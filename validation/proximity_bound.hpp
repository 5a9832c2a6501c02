// proximity-bound: vertex proximity is the nearest vertex pair below theta, and bounds the distance of the surfaces.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Laws, METHOD 3, for the pairs that the subject confirmed; x the positions at detection:
//   - (every frame) the recorded squared distance is that of the two recorded vertices, and below theta^2;
//   - (the first 512 pairs, then 512 of each doubling of their number)
//     no two vertices are nearer than a touching pair's distance,
//     and none are nearer than theta when a pair does not touch; of vertex pairs whose coordinates differ by the same
//     amounts, and which are therefore as near in any arithmetic, the recorded one is the lowest;
//   - a pair that does not touch has no vertices and no distance, and without the vertex stage no pair has any;
//   - (frames that the baseline measured, at the same positions) with d the distance of the surfaces: d <= d_vv, and
//     d_vv <= d + rho_A + rho_B where d > 0; d >= theta - rho_A - rho_B where the pair does not touch. rho is the
//     covering radius of each mesh's vertices.
// Nothing follows for pairs that were not confirmed: disjoint leaf boxes may hold vertices nearer than theta. The
// sentence reports E13's share: of the pairs whose surfaces meet, those that vertices missed.
//
// Limits. World vertices are rounded once per coordinate, so a distance is off by at most sqrt(3) u (W_A + W_B), W the
// largest coordinate of a body's box; the squared distance adds 5 operations (a difference twice, a product, two sums),
// so 3 at most on the distance; theta has 2 (the sum of two mean edges; half of its square's). Baselines compute in
// float64 from the same float32 positions; their own rounding is far below that.
ValidatorRow proximity_bound_row();

}  // namespace broadside::validation
