// The declaration and the equivalence card of the twin where bodies turn.
#pragma once

#include <string>

#include "core/engine/declaration.hpp"
#include "core/engine/equivalence.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/swept_bodies.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"

namespace broadside::reference {

core::Declaration rigid_declaration(const ContactSolverOptions& solver, const core::Scene& scene,
                                    core::Swept swept = core::Swept::kFlagged);

// For a scene whose bodies turn; empty where they translate, since METHOD describes those.
core::EquivalenceCard rigid_card(const core::Scene& scene, const core::SoftSettings& solver, core::Swept swept,
                                 bool sleeps, std::string build, int threads);

}  // namespace broadside::reference
