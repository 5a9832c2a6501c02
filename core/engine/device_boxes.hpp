// Boxes that are already on the device, and pairs that stay there: for callers that work on the same device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pair.hpp"
#include "core/result.hpp"

namespace broadside::core {

// Boxes on the device that the engine runs on. `data`: [count][6] float32, min x y z, max x y z, aligned to 4 bytes.
struct DeviceBoxes {
  const float* data = nullptr;
  std::size_t count = 0;
  // True when work already queued on `stream` (a cudaStream_t; null or 1 = the legacy default stream) may still write
  // the boxes. The engine then reads them after that work.
  bool is_behind_stream = false;
  void* stream = nullptr;
};

// Pairs in memory of the engine, unchanged until its next load, update or find. In no particular order.
struct DevicePairs {
  const Pair* data = nullptr;
  std::uint64_t count = 0;
  int device = 0;
};

// What a broad phase on a device offers besides BroadPhase (core/engine/broad_phase.hpp).
class TakesDeviceBoxes {
 public:
  virtual ~TakesDeviceBoxes() = default;

  // Replaces load and update; is_static is on the host. Both return once the boxes have been read: the caller may then
  // overwrite them, from any stream. The errors are those of load and update.
  virtual Status load_on_device(const DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) = 0;
  virtual Status update_on_device(const DeviceBoxes& boxes) = 0;
  // Called after find(), which returns when the pairs are complete: any stream may read them.
  [[nodiscard]] virtual Result<DevicePairs> pairs_on_device() const = 0;
};

}  // namespace broadside::core
