// What an engine offers beside Dynamics when the host need not come back between two steps: many of them in one call.
#pragma once

#include <cstdint>
#include <functional>

#include "core/result.hpp"

namespace broadside::core {

// A class derived from Dynamics may also derive from this; callers that read nothing between steps look for
// it.
class RunsAhead {
 public:
  virtual ~RunsAhead() = default;

  // Called after each step, in order; stage_times() and counters() then describe that step, and nothing else may be
  // asked. Returns false to stop: no further step begins, and steps that are under way end without a call.
  using StepDone = std::function<bool()>;

  // Like that many step(dt_s), but a step may begin before the last one was reported. Returns when all are complete.
  virtual Status run(float dt_s, std::uint64_t steps, const StepDone& step_done) = 0;
};

}  // namespace broadside::core
