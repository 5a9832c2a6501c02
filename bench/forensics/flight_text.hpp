// Texts that say in what two engines must agree while bodies fly freely, and what was left out.
#pragma once

#include <string>

#include "bench/forensics/flight_rule.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::bench {

// a is the recorded trace, b the one that repeats it.
std::string flight_expectation(const core::TraceHeader& a, const core::TraceHeader& b);

// How many states were judged, and when and why bodies left the comparison.
std::string flight_remark(const FlightRule& rule, const core::TraceHeader& a, const core::TraceHeader& b);

}  // namespace broadside::bench
