// The launch that tells states and points of a frame of turning bodies as columns of the trace, on the device.
#pragma once

#include <cstdint>

#include "core/contact_point.hpp"
#include "core/math/quat.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// Of one body, in the units and frame of the trace.
struct ToldBody {
  core::Vec3 position;  // of the mesh's origin
  core::Quat orientation;
  core::Vec3 velocity;
  core::Vec3 angular_velocity;
};

struct ToldView {
  std::uint32_t body_count = 0;
  std::uint64_t patch_count = 0;
  const core::RigidState* state = nullptr;     // that the step came to
  const core::RigidState* detected = nullptr;  // that it began with
  const core::RigidMass* mass = nullptr;
  const core::Vec3* static_spin = nullptr;  // rad/s
  const core::ContactPatch* patches = nullptr;
  const core::Vec3* impulses = nullptr;  // [4 * patches] N s
  ToldBody* bodies = nullptr;            // [body_count]
  core::ContactPoint* points = nullptr;  // room for 4 * patch_count
  std::uint32_t* point_count = nullptr;  // 0 before the launch
};

// Asynchronous.
core::Status launch_told(const ToldView& view, StreamHandle stream);

}  // namespace broadside::gpu
