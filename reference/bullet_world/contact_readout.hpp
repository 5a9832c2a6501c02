// Bullet's contact manifolds in our conventions.
#pragma once

#include <span>
#include <vector>

#include "core/contact.hpp"
#include "core/contact_point.hpp"

class btDispatcher;

namespace broadside::reference {

// States of every body before and after the step that made the manifolds. `before` has gravity's change of velocity in
// it, as Bullet's solver sees it.
struct StepStates {
  std::span<const core::Kinematics> before;
  std::span<const core::Kinematics> after;
};

// One contact per manifold point that overlaps or carried an impulse, pairs first and faces after them, by body, in
// Bullet's order within a pair. Objects carry their body's number, or that of their face, as user index.
// Bullet resolves all contacts of a step together: each contact of a body has the whole step's states before and after,
// not those of an application of its own. The tangent points against the friction impulse that acted.
std::vector<core::Contact> read_contacts(btDispatcher& dispatcher, const StepStates& states);

// The same manifold points as totals of the step, in the same order: on the surface of the body that moves, or between
// those of two that do, with the normal impulse and friction together.
std::vector<core::ContactPoint> read_points(btDispatcher& dispatcher);

}  // namespace broadside::reference
