// How much energy a recorded run has gained since its start, computed from the states, so that no engine need keep a
// ledger.
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench::contest {

struct EnergyCurve {
  std::vector<double> time_s;    // rising; the start is the first
  std::vector<double> gained_j;  // kinetic energy, of turning too, and that of gravity, less those at the start
};

// At most this many frames of the trace, spread evenly, and its last one.
core::Result<EnergyCurve> energy_curve(const std::filesystem::path& trace, std::size_t most_frames);

}  // namespace broadside::bench::contest
