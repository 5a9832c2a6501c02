// How much longer did one run take than another run of the same frames, disturbed frames aside?
#pragma once

#include <vector>

namespace broadside::reports {

// Head over base, of equally many frames (s), at least one: frame k of the one is divided by frame k of the other, so
// what slowed both at that moment cancels where they ran in turns. The run is cut into up to eight parts of at least
// eight frames; a part counts by the median of its frames' ratios, and the run by the mean of its parts, weighted with
// what they take in the base: a change that touches an eighth of the run is seen, and single disturbed frames are not.
double frame_ratio(const std::vector<double>& base, const std::vector<double>& head);

}  // namespace broadside::reports
