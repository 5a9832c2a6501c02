#include "reference/octree_cpu/rigid/contact_solver.hpp"

#include "reference/octree_cpu/rigid/soft_solver.hpp"

namespace broadside::reference {

std::string_view solver_name(SolverKind) {
  return "soft";
}

std::unique_ptr<ContactSolver> make_contact_solver(const ContactSolverOptions& options) {
  SoftSolverOptions soft;
  soft.substeps = options.substeps;
  return std::make_unique<SoftSolver>(soft);
}

}  // namespace broadside::reference
