#include "reference/plain_rigid/impacts.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/contact.hpp"

namespace broadside::reference::plain {
namespace {

// Relative: some hundred sweeps of float64 additions.
constexpr double kRoundingOfSweeps = 0x1p-44;

// Hits that are solved together, as indices into the list, and the moving bodies that take part in them.
struct Group {
  std::vector<std::size_t> hits;
  std::vector<std::uint32_t> bodies;
};

bool moves(std::uint32_t id, const std::vector<RigidBody>& bodies) {
  return !core::is_face(id) && !bodies[id].is_static();
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// The groups are in the order of each group's least body.
std::vector<Group> groups_of(const std::vector<SolverPoint>& hits, const std::vector<RigidBody>& bodies) {
  std::vector<std::uint32_t> parent(bodies.size());
  std::iota(parent.begin(), parent.end(), 0U);
  std::vector<std::uint8_t> is_hit(bodies.size());
  for (const SolverPoint& p : hits) {
    const bool moves_a = moves(p.a, bodies);
    const bool moves_b = moves(p.b, bodies);
    if (moves_a) is_hit[p.a] = 1;
    if (moves_b) is_hit[p.b] = 1;
    if (!moves_a || !moves_b) continue;
    const std::uint32_t i = root_of(parent, p.a);
    const std::uint32_t j = root_of(parent, p.b);
    parent[std::max(i, j)] = std::min(i, j);
  }
  std::map<std::uint32_t, Group> by_root;
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (is_hit[i] != 0) by_root[root_of(parent, i)].bodies.push_back(i);
  for (std::size_t k = 0; k < hits.size(); ++k)
    by_root[root_of(parent, moves(hits[k].a, bodies) ? hits[k].a : hits[k].b)].hits.push_back(k);
  std::vector<Group> groups;
  groups.reserve(by_root.size());
  for (auto& [root, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

double kinetic_energy(const Group& group, const std::vector<RigidBody>& bodies) {
  double sum = 0.0;
  for (const std::uint32_t i : group.bodies) {
    const RigidBody& b = bodies[i];
    sum += 0.5 * dot(b.v, b.v) / b.inverse_mass + 0.5 * dot(b.angular_velocity(), b.angular_momentum);
  }
  return sum;
}

std::uint64_t solve_group(const Group& group, std::vector<SolverPoint>& hits, std::vector<RigidBody>& bodies,
                          std::uint32_t iterations) {
  std::vector<RigidBody> before;
  for (const std::uint32_t i : group.bodies) before.push_back(bodies[i]);
  std::vector<SolverPoint> unsolved;
  for (const std::size_t k : group.hits) unsolved.push_back(hits[k]);
  const double energy = kinetic_energy(group, bodies);
  std::uint64_t sweeps = 0;
  for (const double share : {1.0, 0.5, 0.25, 0.0}) {
    for (std::size_t k = 0; k < before.size(); ++k) bodies[group.bodies[k]] = before[k];
    std::vector<SolverPoint> rebounds = unsolved;
    for (SolverPoint& p : rebounds) p.least_speed *= share;
    sweeps += solve_velocities(rebounds, bodies, iterations);
    for (std::size_t k = 0; k < rebounds.size(); ++k) {
      rebounds[k].finish_solve();
      hits[group.hits[k]].total_impulse = rebounds[k].total_impulse;
    }
    if (kinetic_energy(group, bodies) <= energy * (1.0 + kRoundingOfSweeps)) break;
  }
  return sweeps;
}

}  // namespace

std::uint64_t solve_rebounds(std::vector<SolverPoint>& hits, std::vector<RigidBody>& bodies, std::uint32_t iterations) {
  std::uint64_t sweeps = 0;
  for (const Group& group : groups_of(hits, bodies)) sweeps += solve_group(group, hits, bodies, iterations);
  return sweeps;
}

}  // namespace broadside::reference::plain
