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
  const BlockCopy* upper_copy = nullptr;  // the copy to wait for, if upper nodes are copied
};

}  // namespace broadside::gpu
