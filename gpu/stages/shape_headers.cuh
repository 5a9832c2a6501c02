// Where the headers of shapes lie: in global memory, or copied into a block's shared memory.
#pragma once

#include "gpu/frame_view.hpp"
#include "gpu/stages/device.cuh"

namespace broadside::gpu {

struct ShapeHeaders {
  const TreeHeader* trees = nullptr;
  const NearCells* cells = nullptr;
};

}  // namespace broadside::gpu
