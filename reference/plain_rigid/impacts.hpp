// Impacts of one step: what meets rebounds, and no group of bodies gains energy by it.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/plain_rigid/rigid_body.hpp"
#include "reference/plain_rigid/solver.hpp"

namespace broadside::reference::plain {

// Each hit's least_speed is that of Newton's restitution. Hits that share bodies that move are solved together, in at
// most `iterations` sweeps, and leave their impulses in total_impulse. With friction Newton's restitution may add
// energy where a body lands askew (Kane and Levinson, Dynamics, 1985): then less of it acts in that group, at last
// none. The energy is each group's own: what others lose in the same step excuses no gain.
// Returns the number of sweeps.
std::uint64_t solve_rebounds(std::vector<SolverPoint>& hits, std::vector<RigidBody>& bodies, std::uint32_t iterations);

}  // namespace broadside::reference::plain
