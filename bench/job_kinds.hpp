// The one table of kinds of jobs (bench/campaign/job.hpp): campaigns that plan their own cells.
#pragma once

#include <span>

#include "bench/campaign/job.hpp"

namespace broadside::bench {

std::span<const campaign::JobKind> job_kinds();

}  // namespace broadside::bench
