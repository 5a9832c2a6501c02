// What the 3-D view of a report shows, taken from traces; no other part of a report reads traces.
#pragma once

#include <filesystem>
#include <vector>

#include "core/rows.hpp"
#include "reports/frame_series.hpp"
#include "reports/playback.hpp"

namespace broadside::bench {

// Some frames of some traces of the folder: for each scene the runs in which a verdict failed or is inconclusive, and
// one that passed; spread evenly over the run, with all recorded frames around each place that a verdict names; all
// together about as much as a page can carry. A trace that is gone or damaged has no playback, and that is no error.
// sharers: how many folders one report shows.
std::vector<reports::Playback> playbacks_of(const core::RunRows& rows, const std::filesystem::path& folder,
                                            std::size_t sharers = 1);

// Penetration over steps (METHOD 9) of each trace that has contacts.
std::vector<reports::FrameSeries> penetration_of(const core::RunRows& rows, const std::filesystem::path& folder);

}  // namespace broadside::bench
