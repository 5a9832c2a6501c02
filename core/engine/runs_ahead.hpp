// What an engine offers besides Dynamics when it can run many steps in one call, without returning to the host in
// between.
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

  // Called after each step, in order. During the call, stage_times() and counters() describe that step, and no other
  // function may be called. Returns false to stop: no further step begins, and steps that are under way end without a
  // call.
  using StepDone = std::function<bool()>;

  // Like that many calls of step(dt_s), but a step may begin before the previous one was reported. Returns when all
  // steps are complete.
  virtual Status run(float dt_s, std::uint64_t steps, const StepDone& step_done) = 0;
};

}  // namespace broadside::core
