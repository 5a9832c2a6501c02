// Beyond the paper: the same scene with up to a hundred times the bodies, and other people's broad phases on its boxes.
#pragma once

#include <vector>

#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Random move at the paper's smallest count of each model times 1, 3, 10, 30 and 100, or at the given counts, with the
// same first frames, at most 20, at every count. Whole frames are run with flat, A, B and C from the published start,
// with tree and with hash; on the CPU also with P-Alg 1's complete octree. Broad phases alone (Bullet's, FCL's,
// all-pairs) get the boxes that octree-cpu recorded. A cell that would take longer than the limit is left out and says
// so: here by its number of box tests, and when its turn comes by the cost at smaller counts (beyond_forecast.hpp).
void add_beyond(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells);

// Which part of a frame is compared: engines that are a broad phase, with the broad stage of the pipelines.
inline constexpr const char* kBroadOnly = "broad phase alone";

bool is_broad_only(const std::string& method);

}  // namespace broadside::bench::paper
