// Pairs handed to their consumer some at a time, for sets whose pairs do not fit in the memory of the engine's device.
#pragma once

#include <functional>

#include "core/engine/device_boxes.hpp"
#include "core/result.hpp"

namespace broadside::core {

// Offered beside BroadPhase by engines that can find pairs in shares.
class HandsPairsOn {
 public:
  // What it returns ends the search where it is an error.
  using Consumer = std::function<Status(const DevicePairs&)>;

  virtual ~HandsPairsOn() = default;
  // The pairs of the boxes of the last load or update, each once and in no order. They stand in the engine's memory
  // until `take` returns.
  virtual Status hand_on(const Consumer& take) = 0;
};

}  // namespace broadside::core
