// Beyond the paper: the same scene with up to a hundred times the bodies, and other people's broad phases on its boxes.
#pragma once

#include <vector>

#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Random move at the paper's smallest count of each model times 1, 3, 10, 30 and 100, or at the given counts; the same
// first frames, at most 20, at every count. Whole frames: flat, A, B, C from the published start, tree, hash; on the
// CPU also P-Alg 1's complete octree. Broad phases alone, fed with the boxes that octree-cpu recorded: Bullet's, FCL's,
// all-pairs. A cell that would take longer than the limit is left out and says so: by its number of box tests here, and
// by its own cost at smaller counts when its turn comes (beyond_forecast.hpp).
void add_beyond(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells);

// What of a frame is compared: broad-phase engines with the broad stage of the pipelines.
inline constexpr const char* kBroadOnly = "broad phase alone";

bool is_broad_only(const std::string& method);

}  // namespace broadside::bench::paper
