// States and pairs of a simulation as they lie on the device, for callers who work on the same device.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/pair.hpp"
#include "core/result.hpp"

namespace broadside::core {

// Memory of the engine, complete for every stream: what the last step left, until the next load or step.
struct DeviceStates {
  const float* position = nullptr;  // m, of the mesh's origin; three float32 at the start of each row
  const float* velocity = nullptr;  // m/s
  std::size_t row_bytes = 0;        // of both, from one body to the next
  std::size_t bodies = 0;
  const Pair* pairs = nullptr;  // candidate pairs of the last step, in no order
  std::uint64_t pair_count = 0;
  int device = 0;
};

// What dynamics on a device offers beside Dynamics (core/engine/dynamics.hpp).
class StatesOnDevice {
 public:
  virtual ~StatesOnDevice() = default;

  // After load, and between steps. Error: nothing was loaded.
  [[nodiscard]] virtual Result<DeviceStates> states_on_device() const = 0;
};

}  // namespace broadside::core
