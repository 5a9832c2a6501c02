// The row of plain-rigid and what it declares.
#pragma once

#include "core/engine/declaration.hpp"
#include "core/engine/engine.hpp"
#include "reference/plain_rigid/plain_world.hpp"

namespace broadside::reference {

core::EngineRow plain_rigid_row();

namespace plain {
core::Declaration declaration(const WorldOptions& options);
}

}  // namespace broadside::reference
