#include "reference/octree_cpu/rigid/rigid_declaration.hpp"

#include <utility>

#include "reference/vendor_build.hpp"

namespace broadside::reference {
namespace {

// A substep adds to velocities for a contact in its start from the last impulse, the solve, the relaxation and the
// rebound.
constexpr int kApplicationsOfSubstep = 4;

}  // namespace

core::Declaration rigid_declaration(const ContactSolverOptions& solver) {
  return core::Declaration::of(
      {{"motion", "rigid"},
       {"detection_at", "start"},
       {"contacts", "totals"},
       {"integrator", "semi-implicit Euler; Runge-Kutta 4 for orientation, angular momentum constant"},
       {"order", "1"},
       {"substeps", std::to_string(solver.substeps)},
       {"iterations", std::to_string(kApplicationsOfSubstep)},
       {"friction", "cone"},
       {"contact_model", "rigid"},
       {"correction", "position"},
       {"precision", "f32"}});
}

core::EquivalenceCard rigid_card(const core::Scene& scene, const ContactSolverOptions& solver, std::string build,
                                 int threads) {
  if (scene.motion != core::Motion::kRigid) return {};
  core::EquivalenceCard card = own_card(std::move(build), "float32 without contraction",
                                        "as the compiler made it; octree joins use AVX2 where it is", threads);
  card.push_back({"shape margin", "none", ""});
  card.push_back({"contact margin", "none: a gap may close within the step, no more", ""});
  card.push_back({"broad-phase margin", "how far bodies may come in the step", ""});
  card.push_back({"friction rule", "geometric mean", ""});
  card.push_back({"restitution rule", "the larger", ""});
  card.push_back(
      {"contact solver", "substeps with soft constraints and relaxation, color by color", "one application a contact"});
  card.push_back({"solver iterations", std::to_string(solver.substeps) + " substeps", "one pass"});
  card.push_back({"rotation", "bodies turn, with the gyroscopic torque", ""});
  card.push_back({"warm starting", "by the features that meet", ""});
  card.push_back({"sleeping", "off", ""});
  return card;
}

}  // namespace broadside::reference
