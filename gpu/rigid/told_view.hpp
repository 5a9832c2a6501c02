// The launch that writes states and points of a frame of turning bodies as columns of the trace, on the device.
#pragma once

#include <cstdint>

#include "core/math/quat.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// One array a column, because some libraries take packed rows only. Units and frame are those of the trace.
struct ToldBodies {
  core::Vec3* position = nullptr;  // of the mesh's origin
  core::Quat* orientation = nullptr;
  core::Vec3* velocity = nullptr;
  core::Vec3* angular_velocity = nullptr;
};

struct ToldPoints {
  std::uint32_t* a = nullptr;
  std::uint32_t* b = nullptr;
  core::Vec3* point = nullptr;
  core::Vec3* normal = nullptr;
  float* gap_m = nullptr;
  core::Vec3* impulse = nullptr;
  std::uint32_t* feature = nullptr;
};

struct ToldView {
  std::uint32_t body_count = 0;
  std::uint64_t patch_count = 0;
  const core::RigidState* state = nullptr;     // at the end of the step
  const core::RigidState* detected = nullptr;  // at its start
  const core::RigidMass* mass = nullptr;
  const core::Vec3* static_spin = nullptr;  // rad/s
  const core::ContactPatch* patches = nullptr;
  const core::Vec3* impulses = nullptr;  // [4 * patches] N s
  ToldBodies bodies;                     // [body_count]
  ToldPoints points;                     // room for 4 * patch_count
  // Both 0 before a launch, and after it.
  std::uint32_t* point_count = nullptr;
  std::uint32_t* blocks_done = nullptr;
  std::uint32_t* told_points = nullptr;  // in the host's memory: how many points were written
};

// Asynchronous.
core::Status launch_told(const ToldView& view, StreamHandle stream);

}  // namespace broadside::gpu
