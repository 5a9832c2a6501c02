// What the kernels of grid frames are given, by value.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/frame/frame_view.hpp"

namespace broadside::gpu {

struct GridFrameView : FrameView {
  BroadView broad;
  LiveBody* live = nullptr;  // [bodies] if contacts are not resolved by one block in its shared memory
};

}  // namespace broadside::gpu
