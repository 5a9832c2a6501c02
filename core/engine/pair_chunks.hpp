// Pairs passed to a consumer in chunks, for sets whose pairs do not fit in the memory of the engine's device.
#pragma once

#include <functional>

#include "core/engine/device_boxes.hpp"
#include "core/result.hpp"

namespace broadside::core {

// Offered besides BroadPhase by engines that can find pairs in chunks.
class HandsPairsOn {
 public:
  // When it returns an error, the search ends with that error.
  using Consumer = std::function<Status(const DevicePairs&)>;

  virtual ~HandsPairsOn() = default;
  // Finds the pairs of the boxes of the last load or update, each once and in no particular order. The pairs of a chunk
  // stay in the engine's memory until `take` returns.
  virtual Status hand_on(const Consumer& take) = 0;
};

}  // namespace broadside::core
