// Launches of frames of turning bodies, as plain functions: rigid_kernel.cu implements them on CUDA,
// on_host/rigid_on_host.cpp with fibers.
#pragma once

#include <cstdint>

#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

core::Result<LaunchShape> rigid_launch_shape();

// Boxes, a launch before the broad phase. Asynchronous, as all of these.
core::Status launch_place(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream);
// All the rest, behind the broad phase.
core::Status launch_rigid_frame(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream);

// What the last frame left. Adds to *digest.
struct RigidDigestView {
  std::uint32_t body_count = 0;
  std::uint64_t confirmed_count = 0;
  std::uint64_t patch_count = 0;
  const core::RigidState* detected = nullptr;
  const core::RigidState* state = nullptr;
  const core::RigidMass* mass = nullptr;
  const core::Vec3* static_spin = nullptr;  // rad/s, of bodies that never turn
  const core::Pair* confirmed = nullptr;
  const core::ContactPatch* patches = nullptr;
  const core::Vec3* impulses = nullptr;
  unsigned long long* digest = nullptr;
};
core::Status launch_rigid_digest(const RigidDigestView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
