// The nearest vertices of each confirmed pair, P-Alg A2 and P(7), P(8).
#pragma once

#include <span>
#include <vector>

#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "core/parameters.hpp"
#include "reference/octree_cpu/bodies.hpp"

namespace broadside::reference {

// One Proximity per pair: the nearest of all vertex pairs below the pair's theta, whatever leaves they are in.
void measure_proximity(const Bodies& bodies, const core::Parameters& parameters, std::span<const core::Pair> confirmed,
                       std::vector<core::Proximity>& out);

}  // namespace broadside::reference
