// In which order bodies are painted, so that nearer ones hide farther ones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/cli/picture_plane.hpp"
#include "bench/cli/seen_body.hpp"

namespace broadside::bench {

// Indices into `bodies`, farther bodies first. In each pixel that several bodies cover, their depths decide. The
// centers of bodies do not tell which hides which: a cube on the far end of a plank hides the plank, and its center is
// farther. Where bodies hide each other in a ring, the one whose center is farthest is painted first.
std::vector<std::size_t> paint_order(std::span<const SeenBody> bodies, const PicturePlane& plane);

}  // namespace broadside::bench
