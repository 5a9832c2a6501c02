// A timing measurement with its stamp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/stamp.hpp"

namespace broadside::core {

// Seconds of one stage in every frame of one repetition.
struct StageSeries {
  std::string stage;  // "integrate", "broad", ...; "frame" is the whole step
  std::vector<double> seconds;
};

struct Sample {
  Stamp stamp;
  std::uint32_t repetition = 0;
  // Distinguishes runs of one process from those of another: processes differ by more than runs of one process do
  // (memory placement, the address layout that the loader chose). 0 = unknown.
  std::uint64_t process = 0;
  std::uint32_t warm_up_frames = 0;
  std::vector<StageSeries> stages;
  // Digest of the last frame, read after the clock stopped: the result to which this time belongs. It must equal the
  // recorded trace's digest of the same step; otherwise the time is struck out.
  std::uint64_t final_digest = 0;
  std::uint64_t final_step = 0;
};

}  // namespace broadside::core
