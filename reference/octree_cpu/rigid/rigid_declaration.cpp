#include "reference/octree_cpu/rigid/rigid_declaration.hpp"

#include <cstdint>
#include <string>
#include <utility>

#include "core/method/rigid/rigid_declaration.hpp"
#include "core/method/rigid/step_in_parts.hpp"
#include "reference/vendor_build.hpp"

namespace broadside::reference {

core::Declaration rigid_declaration(const ContactSolverOptions& solver, const core::Scene& scene, core::Swept swept) {
  return core::rigid_declaration(soft_settings(solver), scene, swept);
}

core::EquivalenceCard rigid_card(const core::Scene& scene, const core::SoftSettings& solver, core::Swept swept,
                                 bool sleeps, std::string build, int threads) {
  if (scene.motion != core::Motion::kRigid) return {};
  core::EquivalenceCard card = own_card(std::move(build), "float32 without contraction",
                                        "as the compiler made it; octree joins use AVX2 where it is", threads);
  card.push_back({"shape margin", "none", ""});
  card.push_back({"contact margin", "none: a gap may close within the step, no more", ""});
  card.push_back({"broad-phase margin", "how far bodies may move in the step", ""});
  card.push_back({"friction rule", "geometric mean", ""});
  card.push_back({"restitution rule", "the larger", ""});
  const float ratio = core::largest_mass_ratio(scene);
  const bool are_swept = !core::swept_bodies(scene, swept).empty();
  const std::uint32_t parts = core::most_parts(solver, ratio, are_swept);
  const std::string substeps =
      std::to_string(core::most_of_step(solver, ratio, true, are_swept).substeps) + " substeps";
  const bool converges = solver.even.sweeps > 1;
  card.push_back({"contact solver",
                  std::string("substeps with soft constraints and relaxation") +
                      (converges ? ", along conjugate directions" : ", color by color"),
                  "one application a contact"});
  card.push_back(
      {"solver iterations",
       converges ? "until little changes, in at most " + substeps : "one sweep in each of at most " + substeps,
       "one pass"});
  card.push_back({"detection in a step",
                  parts > 1
                      ? "up to " + std::to_string(parts) + " times: where bodies move far, or masses are far apart"
                      : std::string("once"),
                  parts > 1 ? "once" : ""});
  card.push_back({"rotation", "bodies turn, with the gyroscopic torque", ""});
  card.push_back({"warm starting", "by the features that meet", ""});
  card.push_back({"sleeping", sleeps ? "on: islands that stand still" : "off", sleeps ? "off" : ""});
  return card;
}

}  // namespace broadside::reference
