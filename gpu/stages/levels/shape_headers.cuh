// Where the headers of shapes lie, and the upper nodes of their trees: in global memory, or copied into a block's
// shared memory.
#pragma once

#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

struct ShapeHeaders {
  const TreeHeader* trees = nullptr;
  const NearCells* cells = nullptr;
  const PackedBox* upper = nullptr;
  const BlockCopy* upper_copy = nullptr;  // if it is on its way there: to be waited for
};

}  // namespace broadside::gpu
