// A step that is taken in several equal parts, each of which detects anew, as one frame of a trace: RIGID 8.4.
//
// Where masses are far apart (UnevenStep), light bodies that are struck move and turn within a step to poses where they
// touch at points that its start does not show. The frame has the states of the bodies after the last part, their poses
// between the parts, what was detected at the start of the step, and the points of all parts. A contact that lasts has
// one point in each part, with the impulse that it gave there.
#pragma once

#include <utility>
#include <vector>

#include "core/method/rigid/soft_settings.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"

namespace broadside::core {

// The mass of the heaviest body that moves over that of the lightest; at least 1.
float largest_mass_ratio(const Scene& scene);

class StepInParts {
 public:
  void begin() { earlier_.clear(); }
  // Call for all parts but the last one, in order. part: the frame that was read back in full after the part.
  void add(FrameRecord part) { earlier_.push_back(std::move(part)); }
  // last: the frame of the last part, read back in full. It becomes the frame of the step at this level, with the
  // digest of the step.
  void join(FrameRecord& last, RecordLevel level) const;

 private:
  std::vector<FrameRecord> earlier_;
};

}  // namespace broadside::core
