// Ids that no frame may contain: a body that the scene does not have, or a vertex that its mesh does not have.
#pragma once

#include <optional>
#include <string>

#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"

namespace broadside::core {

struct FrameFault {
  std::string at;      // the dataset, "/trace/pairs/pairs"
  std::string what;    // what is wrong, with the step
  std::string advice;  // what to do about it
};

// The first fault; nothing for a frame that may be written and read. Readers refuse a file that has such a frame, and
// the Python package refuses the frame before it is written.
std::optional<FrameFault> fault_of(const FrameRecord& frame, const Scene& scene);

}  // namespace broadside::core
