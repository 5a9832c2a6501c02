// Candidates of continuous collision on every core.
#pragma once

#include <span>

#include "core/continuous/feature_candidates.hpp"

namespace broadside::reference {

// As CandidateFinder::add of all pairs, in the same order whatever the number of workers; 0 = one a core.
continuous::FeaturePairs find_candidates(const continuous::CandidateFinder& finder,
                                         std::span<const core::Pair> triangles, unsigned workers = 0);

}  // namespace broadside::reference
