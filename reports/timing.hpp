// The samples of one stamp taken together: one line of a table of times.
#pragma once

#include <string>
#include <vector>

#include "core/rows.hpp"
#include "reports/admission.hpp"
#include "reports/statistics.hpp"

namespace broadside::reports {

struct StageTiming {
  std::string stage;
  Summary seconds;  // per frame, over all frames of all repetitions
};

struct Timing {
  core::Stamp stamp;
  std::uint64_t repetitions = 0;
  std::uint64_t warm_up_frames = 0;  // run before the first timed one; not in the figures
  std::vector<StageTiming> stages;   // in pipeline order, without the whole frame
  Summary frame;                     // the stage "frame", or the sum of the stages for an engine without one
  bool frame_is_sum = false;
  Summary fps;  // one value per repetition: its frames over the sum of their times
  // Not admitted when any of its samples is not: with one wrong answer no time of the stamp can be trusted.
  Admission admission;
};

// In order of first appearance.
std::vector<Timing> pool_samples(const core::RunRows& rows);

}  // namespace broadside::reports
