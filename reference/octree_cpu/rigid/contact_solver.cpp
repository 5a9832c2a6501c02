#include "reference/octree_cpu/rigid/contact_solver.hpp"

#include "reference/octree_cpu/rigid/soft_solver.hpp"

namespace broadside::reference {

std::string_view solver_name(SolverKind kind) {
  return kind == SolverKind::kSoftStep ? "soft-step" : "conjugate";
}

namespace {

SoftSolverOptions soft_options(const ContactSolverOptions& options) {
  SoftSolverOptions soft = options.kind == SolverKind::kSoftStep ? soft_step_options() : SoftSolverOptions{};
  if (options.substeps > 0) soft.substeps = options.substeps;
  soft.limits.fixed_slop_m = options.fixed_slop_m;
  soft.fixed_bounce_from_m_s = options.fixed_bounce_from_m_s;
  return soft;
}

}  // namespace

// Uneven masses take twice the substeps. A sweep and the direction after it, the start from the substep before, the
// relaxation and the bounce each add to velocities.
ContactSolverFacts facts_of(const ContactSolverOptions& options) {
  const SoftSolverOptions soft = soft_options(options);
  return {2 * soft.substeps, 2 * soft.sweeps + 3};
}

std::unique_ptr<ContactSolver> make_contact_solver(const ContactSolverOptions& options) {
  return std::make_unique<SoftSolver>(soft_options(options));
}

}  // namespace broadside::reference
