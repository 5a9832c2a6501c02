// Times as plain text for a terminal.
#pragma once

#include <string>
#include <vector>

#include "reports/timing.hpp"

namespace broadside::reports {

// One line per engine: frames per second and median frame time with quartiles, or why the time does not count.
std::string timing_table(const std::vector<Timing>& timings);

}  // namespace broadside::reports
