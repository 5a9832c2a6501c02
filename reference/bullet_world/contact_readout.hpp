// Bullet's contact manifolds in our conventions.
#pragma once

#include <span>
#include <vector>

#include "core/contact.hpp"
#include "core/contact_point.hpp"

class btDispatcher;

namespace broadside::reference {

// States of every body before and after the step that made the manifolds. `before` includes gravity's change of
// velocity, as Bullet's solver sees it.
struct StepStates {
  std::span<const core::Kinematics> before;
  std::span<const core::Kinematics> after;
};

// One contact per manifold point that overlaps or carried an impulse: pairs first, then faces, ordered by body, and in
// Bullet's order within a pair. The user index of an object is the number of its body or face. Bullet resolves all
// contacts of a step together: each contact of a body has the states before and after the whole step, not those of an
// application of its own. The tangent points against the friction impulse that acted.
std::vector<core::Contact> read_contacts(btDispatcher& dispatcher, const StepStates& states);

// The same manifold points as totals of the step, in the same order. A point is on the surface of the body that moves,
// or in the middle between the surfaces where both move; its impulse is the normal impulse and friction together.
std::vector<core::ContactPoint> read_points(btDispatcher& dispatcher);

}  // namespace broadside::reference
