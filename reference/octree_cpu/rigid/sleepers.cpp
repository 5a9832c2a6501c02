#include "reference/octree_cpu/rigid/sleepers.hpp"

#include <algorithm>
#include <cstddef>

#include "core/contact.hpp"
#include "core/method/rigid/sleep.hpp"

namespace broadside::reference {

using core::ContactPatch;

void Sleepers::load(const core::RigidBodies& bodies) {
  is_static_ = bodies.is_static;
  island_.resize(bodies.count());
  parent_.resize(bodies.count());
  is_restless_.resize(bodies.count());
  steps_slept_ = 0;
  wake_all();
}

void Sleepers::wake_all() {
  asleep_.assign(is_static_.size(), 0);
  still_.assign(is_static_.size(), 0);
  count_ = 0;
}

bool Sleepers::wake_touched(std::span<const ContactPatch> patches) {
  if (count_ == 0) return false;
  is_restless_.assign(asleep_.size(), 0);  // by the lowest body of an island; 1: the island wakes
  bool wakes = false;
  const auto touch = [&](std::uint32_t sleeper, std::uint32_t other) {
    if (core::is_face(sleeper) || asleep_[sleeper] == 0) return;
    if (core::is_face(other) || is_static_[other] != 0 || asleep_[other] != 0) return;
    is_restless_[island_[sleeper]] = 1;
    wakes = true;
  };
  for (const ContactPatch& patch : patches) {
    touch(patch.a, patch.b);
    touch(patch.b, patch.a);
  }
  if (!wakes) return false;
  for (std::size_t i = 0; i < asleep_.size(); ++i) {
    if (asleep_[i] == 0 || is_restless_[island_[i]] == 0) continue;
    asleep_[i] = 0;
    still_[i] = 0;
    --count_;
  }
  return true;
}

// The root of a body's tree (union-find). Paths are halved while they are followed.
std::uint32_t Sleepers::root(std::uint32_t body) {
  while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
  return body;
}

void Sleepers::fall_asleep(core::RigidBodies& bodies, std::span<const ContactPatch> patches, core::Vec3 gravity_m_s2,
                           float dt_s) {
  steps_slept_ += count_;
  const float speed = core::sleep_speed_m_s(gravity_m_s2, dt_s);
  if (!(speed > 0.0F)) return;
  for (std::uint32_t i = 0; i < bodies.count(); ++i) parent_[i] = i;
  for (const ContactPatch& patch : patches) {
    if (core::is_face(patch.b) || is_static_[patch.a] != 0 || is_static_[patch.b] != 0) continue;
    const std::uint32_t p = root(patch.a);
    const std::uint32_t q = root(patch.b);
    // The lowest body is the root.
    parent_[std::max(p, q)] = std::min(p, q);
  }
  is_restless_.assign(bodies.count(), 0);
  for (std::uint32_t i = 0; i < bodies.count(); ++i) {
    if (is_static_[i] != 0 || asleep_[i] != 0) continue;
    const float outer_m = bodies.shapes[bodies.shape[i]].balls.outer_m;
    still_[i] = core::still_steps(still_[i], bodies.state[i], bodies.mass[i], outer_m, speed);
    if (still_[i] < core::still_steps_to_sleep(outer_m, gravity_m_s2, dt_s)) is_restless_[root(i)] = 1;
  }
  for (std::uint32_t i = 0; i < bodies.count(); ++i) {
    if (is_static_[i] != 0 || asleep_[i] != 0 || is_restless_[root(i)] != 0) continue;
    asleep_[i] = 1;
    island_[i] = root(i);
    bodies.state[i] = core::stopped(bodies.state[i]);
    ++count_;
  }
}

}  // namespace broadside::reference
