// States, pairs and points of a simulation as they lie on the device, for callers who work on the same device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::core {

// One column of a frame; numbers of 32 bits.
struct DeviceColumn {
  std::string_view path;  // of the trace's column of the same meaning and unit, such as body/position
  const void* data = nullptr;
  std::uint64_t rows = 0;
  std::uint32_t width = 1;    // numbers of a row
  std::size_t row_bytes = 0;  // from one row to the next
  bool is_float = true;       // else whole numbers without a sign
};

// Memory of the engine, complete for every stream: what the last step left, until the next load or step. Bodies come in
// the scene's order, pairs and points in none.
struct DeviceFrame {
  std::vector<DeviceColumn> columns;
  int device = 0;
};

// What dynamics on a device offers beside Dynamics (core/engine/dynamics.hpp).
class FrameOnDevice {
 public:
  virtual ~FrameOnDevice() = default;

  // After load, and between steps. Error: nothing was loaded.
  [[nodiscard]] virtual Result<DeviceFrame> frame_on_device() = 0;
};

}  // namespace broadside::core
