// What an engine offers besides Dynamics when its frames are on a device: copies that run while it computes the next
// step.
#pragma once

#include "core/result.hpp"
#include "core/trace/frame.hpp"

namespace broadside::core {

// A class derived from Dynamics may also derive from this; the recorder looks for it. Order of calls: step, start,
// step, finish, start, step, finish ... : one copy is under way while the next frame is computed, in one of two
// buffers.
class FrameCopies {
 public:
  virtual ~FrameCopies() = default;

  // Starts to copy the frame that the last step made, and returns; later steps do not change what is being copied.
  // Waits only when the copy before the previous one is not finished yet. kDigest copies digest and counts only.
  virtual Status start_copy(RecordLevel level) = 0;
  // Waits for the oldest copy under way, and gives what read_back would have given when that copy was started.
  virtual Status finish_copy(FrameRecord& frame) = 0;
};

}  // namespace broadside::core
