// Several devices of one host: which of them this thread works on, and copies from one to another. Two files implement
// this header, as they do device_runtime.hpp.
#pragma once

#include <cstddef>

#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Result<int> device_count();
// The device on which allocations and launches of this thread are made.
core::Result<int> current_device();
core::Status use_device(int device);

// Lets copies from `peer` go directly to `device` if the machine can do that; else they pass through the host.
core::Status let_reach(int device, int peer);
// Puts the copy into the stream, which may belong to either device; returns at once.
core::Status copy_between_devices(void* to, int to_device, const void* from, int from_device, std::size_t bytes,
                                  StreamHandle stream);

// At the end of a scope, goes back to the device that this thread used before.
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
