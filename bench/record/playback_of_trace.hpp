// What the 3-D view of a report shows, taken from traces; no other part of a report reads traces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/rows.hpp"
#include "reports/frame_series.hpp"
#include "reports/playback.hpp"

namespace broadside::bench {

// What one folder may add to a page.
struct PlaybackShare {
  std::uint64_t most_bytes = 0;  // of all playbacks, encoded
  std::size_t most_runs = 0;
  // Takes every run, so that engines can be compared side by side, instead of only the runs with something to show.
  bool every_run = false;
};

// What one of so many folders may add: an equal share of what a page can carry.
PlaybackShare share_of(std::size_t folders);

// Some frames of some traces of the folder. For each scene it takes the runs in which a verdict failed or is
// inconclusive, and one that passed; frames are spread evenly over the run, with all recorded frames around each place
// that a verdict names. Together they take about as much as the share allows. A trace that is gone or damaged has no
// playback, which is no error.
std::vector<reports::Playback> playbacks_of(const core::RunRows& rows, const std::filesystem::path& folder,
                                            const PlaybackShare& share);

// Penetration over steps (METHOD 9) of each trace that has contacts.
std::vector<reports::FrameSeries> penetration_of(const core::RunRows& rows, const std::filesystem::path& folder);

}  // namespace broadside::bench
