// The engines of this folder, as rows for the one table of engines.
#pragma once

#include "core/engine/engine.hpp"

namespace broadside::gpu {

// The rows exist even if the engines cannot run here; absent() then says why.
core::EngineRow octree_gpu_row();
core::EngineRow hash_gpu_row();

}  // namespace broadside::gpu
