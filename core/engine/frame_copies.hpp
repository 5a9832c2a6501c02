// What an engine offers beside Dynamics when its frames lie on a device: copies that run while it steps on.
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

  // Starts to copy the frame that the last step made, and returns; later steps do not touch what is copied. Waits only
  // when the copy before the last is not finished yet. kDigest copies digest and counts only.
  virtual Status start_copy(RecordLevel level) = 0;
  // Waits for the oldest copy under way, and gives what read_back would have given then.
  virtual Status finish_copy(FrameRecord& frame) = 0;
};

}  // namespace broadside::core
