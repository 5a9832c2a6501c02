// The request for a campaign of the paper's experiments. Its cells follow from it, in the same order every time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/paper/paper_plan.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

struct PaperRequest {
  std::vector<std::string> experiments;
  PlanOptions plan;
  Device device;
  std::string machine;  // only cells of this machine are taken over; empty = of any, as on a cluster
  bool allow_stand_in = false;
  bool keeps_traces = false;
};

// Writes the request as JSON for a manifest, and reads it back. Damaged text is an error that says what is missing.
std::string text_of(const PaperRequest& request);
core::Result<PaperRequest> request_from(std::string_view text);

}  // namespace broadside::bench::paper
