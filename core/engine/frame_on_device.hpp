// States, pairs and points of a simulation in device memory, for callers that work on the same device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::core {

// One column of a frame, made of 32-bit numbers.
struct DeviceColumn {
  std::string_view path;  // the trace column with the same meaning and unit, such as body/position
  const void* data = nullptr;
  std::uint64_t rows = 0;
  std::uint32_t width = 1;    // numbers in a row
  std::size_t row_bytes = 0;  // from one row to the next
  bool is_float = true;       // otherwise unsigned integers
};

// Memory of the engine that is complete for every stream: the state after the last step, until the next load or step.
// Bodies are in the scene's order, pairs and points in no particular order.
struct DeviceFrame {
  std::vector<DeviceColumn> columns;
  int device = 0;
};

// What dynamics on a device offer besides Dynamics (core/engine/dynamics.hpp).
class FrameOnDevice {
 public:
  virtual ~FrameOnDevice() = default;

  // Called after load, and between steps. Error: nothing was loaded.
  [[nodiscard]] virtual Result<DeviceFrame> frame_on_device() = 0;
};

}  // namespace broadside::core
