// What an engine offers beside Dynamics when the host need not come back between two steps: many of them in one call.
#pragma once

#include <cstdint>
#include <functional>

#include "core/result.hpp"

namespace broadside::core {

// A class derived from Dynamics may also derive from this; whoever steps without reading anything in between looks for
// it.
class RunsAhead {
 public:
  virtual ~RunsAhead() = default;

  // Told after each step, in order; stage_times() and counters() are then of that step, and nothing else may be asked.
  // False: no further step begins; those under way are done all the same, and not told of.
  using StepDone = std::function<bool()>;

  // As so many calls of step(dt_s). A step may begin before the one before it is told of. Returns when all is complete.
  virtual Status run(float dt_s, std::uint64_t steps, const StepDone& step_done) = 0;
};

}  // namespace broadside::core
