// Candidates of continuous collision, found on all cores.
#pragma once

#include <span>

#include "core/continuous/feature_candidates.hpp"

namespace broadside::reference {

// Gives the result of CandidateFinder::add for all pairs, in the same order whatever the number of workers; 0 = one a
// core.
continuous::FeaturePairs find_candidates(const continuous::CandidateFinder& finder,
                                         std::span<const core::Pair> triangles, unsigned workers = 0);

}  // namespace broadside::reference
