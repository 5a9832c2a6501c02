// What an engine offers besides Dynamics when it times its own steps, such as a program behind a pipe, whose wall time
// includes the pipe.
#pragma once

namespace broadside::core {

// A class derived from Dynamics may also derive from this; timing looks for it.
class OwnStepTime {
 public:
  virtual ~OwnStepTime() = default;

  // Seconds that the last step took by the engine's own clock; NaN where it does not report them.
  [[nodiscard]] virtual double last_step_s() const = 0;
};

}  // namespace broadside::core
