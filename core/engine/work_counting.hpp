// What an engine offers besides its capability when counting its work costs time: it counts only when asked to.
#pragma once

namespace broadside::core {

// A class derived from Dynamics or BroadPhase may also derive from this. Recordings of whole frames ask for it; timed
// runs do not.
class CountsWork {
 public:
  virtual ~CountsWork() = default;

  // From the next load on, counters() also has the counts that cost time.
  virtual void count_work() = 0;
};

}  // namespace broadside::core
