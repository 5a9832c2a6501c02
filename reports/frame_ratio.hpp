// How much longer one run took than another run of the same frames, without disturbed frames.
#pragma once

#include <vector>

namespace broadside::reports {

// Head over base, from the times (s) of at least one frame; both have equally many. Frame k of one is divided by frame
// k of the other, so that a disturbance of both at that moment cancels where they ran in turns. The run is cut into up
// to eight parts of at least eight frames. A part counts by the median of its frames' ratios, and the run by the mean
// of its parts, weighted with their time in the base. So a change in an eighth of the run shows, and single disturbed
// frames do not.
double frame_ratio(const std::vector<double>& base, const std::vector<double>& head);

}  // namespace broadside::reports
