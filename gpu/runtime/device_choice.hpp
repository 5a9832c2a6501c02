// Several devices of one host: which of them this thread works on, and copies from one to another. Two files implement
// it, as device_runtime.hpp.
#pragma once

#include <cstddef>

#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Result<int> device_count();
// The device on which allocations and launches of this thread are made.
core::Result<int> current_device();
core::Status use_device(int device);

// Lets copies from `peer` go straight to `device`, where the machine can; elsewhere they pass through the host.
core::Status let_reach(int device, int peer);
// Asked of the stream, which is of either device; returns at once.
core::Status copy_between_devices(void* to, int to_device, const void* from, int from_device, std::size_t bytes,
                                  StreamHandle stream);

// Goes back to the device of before at the end of a scope.
class DeviceScope {
 public:
  DeviceScope() {
    if (auto device = current_device(); device.ok()) before_ = device.value();
  }
  ~DeviceScope() { (void)use_device(before_); }
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;

 private:
  int before_ = 0;
};

}  // namespace broadside::gpu
