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

MostOfStep most_of_step(const ContactSolverOptions& options) {
  const SoftSolverOptions soft = soft_options(options);
  // The start from the last impulse, sweeps with a step along the direction between two, relaxation and rebound.
  return {2 * soft.substeps, 1 + (2 * soft.sweeps - 1) + 1 + 1};
}

std::unique_ptr<ContactSolver> make_contact_solver(const ContactSolverOptions& options) {
  return std::make_unique<SoftSolver>(soft_options(options));
}

}  // namespace broadside::reference
