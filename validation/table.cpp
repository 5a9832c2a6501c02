#include <array>

#include "validation/candidate_set.hpp"
#include "validation/capacity.hpp"
#include "validation/center_of_mass.hpp"
#include "validation/contact_normal.hpp"
#include "validation/contraction.hpp"
#include "validation/determinism.hpp"
#include "validation/energy.hpp"
#include "validation/friction_energy.hpp"
#include "validation/judge.hpp"
#include "validation/level_agreement.hpp"
#include "validation/metamorphic.hpp"
#include "validation/normal_energy.hpp"
#include "validation/octree_invariants.hpp"
#include "validation/proximity_bound.hpp"
#include "validation/restitution.hpp"
#include "validation/stability.hpp"
#include "validation/state_sanity.hpp"
#include "validation/velocity_cap.hpp"

namespace broadside::validation {

// A new validator is one file pair and one line here; reports keep this order.
std::span<const ValidatorRow> validators() {
  static const std::array kRows{
      candidate_set_row(), capacity_row(),       level_agreement_row(), proximity_bound_row(),   contact_normal_row(),
      contraction_row(),   center_of_mass_row(), restitution_row(),     normal_energy_row(),     friction_energy_row(),
      energy_row(),        velocity_cap_row(),   stability_row(),       octree_invariants_row(), state_sanity_row(),
      determinism_row(),   metamorphic_row(),
  };
  return kRows;
}

}  // namespace broadside::validation
