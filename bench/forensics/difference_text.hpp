// A comparison of two traces in words, and as JSON.
#pragma once

#include <string>

#include "bench/forensics/trace_difference.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

// Which trace is which, what was compared, the first difference, and the contact history. Ends with a newline.
std::string difference_text(const core::TraceReader& a, const core::TraceReader& b, const TraceDifference& difference);

// The same as one JSON object. Values are texts with enough digits to name their bits, so NaN and infinity are kept.
std::string difference_json(const core::TraceReader& a, const core::TraceReader& b, const TraceDifference& difference);

}  // namespace broadside::bench
