// What two engines that fly alike have to agree in, and what was left out, in words.
#pragma once

#include <string>

#include "bench/forensics/flight_rule.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::bench {

// a recorded, b repeats.
std::string flight_expectation(const core::TraceHeader& a, const core::TraceHeader& b);

// How many states were judged, and when and why bodies left the comparison.
std::string flight_remark(const FlightRule& rule, const core::TraceHeader& a, const core::TraceHeader& b);

}  // namespace broadside::bench
