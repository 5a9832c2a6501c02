#include "reference/octree_cpu/rigid/contact_solver.hpp"

#include "reference/octree_cpu/rigid/soft_solver.hpp"

namespace broadside::reference {

std::string_view solver_name(SolverKind kind) {
  return kind == SolverKind::kSoftStep ? "soft-step" : "conjugate";
}

core::SoftSettings soft_settings(const ContactSolverOptions& options) {
  core::SoftSettings soft = options.kind == SolverKind::kSoftStep ? core::soft_step_settings() : core::SoftSettings{};
  if (options.substeps > 0) soft = core::with_substeps(soft, options.substeps);
  soft.limits.fixed_slop_m = options.fixed_slop_m;
  soft.fixed_bounce_from_m_s = options.fixed_bounce_from_m_s;
  return soft;
}

std::unique_ptr<ContactSolver> make_soft_solver(const core::SoftSettings& settings) {
  return std::make_unique<SoftSolver>(settings);
}

std::unique_ptr<ContactSolver> make_contact_solver(const ContactSolverOptions& options) {
  return make_soft_solver(soft_settings(options));
}

}  // namespace broadside::reference
