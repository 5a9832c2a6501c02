// What an engine offers beside its capability when counting its work takes time: it counts where it was asked to.
#pragma once

namespace broadside::core {

// A class derived from Dynamics or BroadPhase may also derive from this; whoever records whole frames looks for it, and
// whoever times does not ask.
class CountsWork {
 public:
  virtual ~CountsWork() = default;

  // From the next load on, counters() has the work too that takes time to count.
  virtual void count_work() = 0;
};

}  // namespace broadside::core
