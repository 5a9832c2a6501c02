// The device's memory for plug-ins that want their arrays there (core/plugin/memory_space.hpp).
#pragma once

#include <memory>
#include <string>

#include "core/plugin/memory_space.hpp"

namespace broadside::gpu {

// An error if there is no device, or if this was built without CUDA.
core::Result<std::unique_ptr<core::MemorySpace>> make_device_space();

// Why there is no device; empty if there is one.
std::string device_absent();

}  // namespace broadside::gpu
