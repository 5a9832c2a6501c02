// What differs between a build with CUDA and one without: two files implement this header, CMake takes one.
#pragma once

#include <string>

#include "core/engine/engine.hpp"

namespace broadside::gpu {

// Why GPU engines cannot run here: "no device", "no device: built without CUDA"; empty when they can.
std::string gpu_absent();

core::Result<core::Engine> create_octree_gpu(const core::Settings& settings);
core::Result<core::Engine> create_hash_gpu(const core::Settings& settings);

// The GPU and its driver, for stamps and results: "NVIDIA H100 80GB HBM3, driver 13.0"; "no device" where there is
// none.
std::string device_name();

}  // namespace broadside::gpu
