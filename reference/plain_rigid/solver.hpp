// Contact impulses of one step: projected Gauss-Seidel over all points, along conjugate directions, until it is done.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.hpp"
#include "reference/plain_rigid/rigid_body.hpp"
#include "reference/plain_rigid/touching.hpp"

namespace broadside::reference::plain {

// A point that may carry an impulse in this step. B may be a face of the domain.
struct SolverPoint {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  NearPoint at;
  core::Material surface;       // of both, combined
  double least_speed = 0.0;     // m/s along the normal: the speed that a solve must leave, at least
  double normal_impulse = 0.0;  // N s, >= 0, of one solve
  Vec friction_impulse;         // N s on A, of one solve
  bool slides = false;          // in one solve, once static friction could not hold it
  Vec total_impulse;            // N s on A, of the whole step

  void finish_solve() {
    total_impulse = total_impulse + normal_impulse * at.normal + friction_impulse;
    normal_impulse = 0.0;
    friction_impulse = {};
    slides = false;
  }
};

struct SolverOptions {
  std::uint32_t iterations = 100;
  double slop_m = 0.0;
  double correction_rate = 0.2;  // share of the depth beyond the slop that a step takes away
};

// Starts with the impulses that the points hold, and changes velocities and angular momenta until every point separates
// at least_speed or faster, pushes only, and has friction within Coulomb's cone. Moreau, Unilateral contact and dry
// friction (1988), solved as in Jourdan, Alart and Jean, A Gauss-Seidel like algorithm to solve frictional contact
// problems (1998), with one effective mass for the tangent plane. Ends after `iterations` sweeps, or when a sweep
// changes next to nothing. Returns the number of sweeps.
std::uint32_t solve_velocities(std::vector<SolverPoint>& points, std::vector<RigidBody>& bodies,
                               std::uint32_t iterations);

// Pushes bodies out of each other without changing their velocities.
void correct_positions(const std::vector<SolverPoint>& points, std::vector<RigidBody>& bodies,
                       const SolverOptions& options);

}  // namespace broadside::reference::plain
