// Impacts of one step: bodies that meet rebound, and no group of bodies gains energy by it.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/plain_rigid/rigid_body.hpp"
#include "reference/plain_rigid/solver.hpp"

namespace broadside::reference::plain {

// Each hit's least_speed is that of Newton's restitution. Hits that share moving bodies are solved together, in at most
// `iterations` sweeps; the impulses are left in total_impulse. With friction Newton's restitution may add energy where
// a body lands askew (Kane and Levinson, Dynamics, 1985): then less restitution is applied in that group, and none in
// the end. The energy is counted for each group alone: energy that other bodies lose in the same step does not make up
// for a gain. Returns the number of sweeps.
std::uint64_t solve_rebounds(std::vector<SolverPoint>& hits, std::vector<RigidBody>& bodies, std::uint32_t iterations);

}  // namespace broadside::reference::plain
