// The engine `octree-cpu`.
#pragma once

#include "core/engine/engine.hpp"

namespace broadside::reference {

core::EngineRow octree_cpu_row();

}  // namespace broadside::reference
