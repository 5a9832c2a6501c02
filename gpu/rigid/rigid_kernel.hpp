// Launches of frames of turning bodies, as plain functions: the kernels of this folder implement them on CUDA,
// on_host/rigid_on_host.cpp with fibers.
#pragma once

#include <cstdint>

#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/rigid/contact_launch.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// A frame is four launches beside its broad phase, one more where shapes are hulls or meshes or where bodies are swept,
// two more where bodies may sleep; all are asynchronous. Each launch is a kernel of its own, so that none needs the
// registers of another. A kernel that finds the frame aborted does nothing; the solver's kernel then tells the host.

core::Result<LaunchShape> constraint_launch_shape();

// How the solver's kernel fits this GPU.
struct SolveShape {
  LaunchShape grid;
  std::uint32_t cluster_blocks = 1;  // of the largest cluster
};
core::Result<SolveShape> solve_launch_shape();

// Boxes, before the broad phase. shape: contact_launch_shape's.
core::Status launch_place(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream);
// Colors and constraints.
core::Status launch_constraints(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream);
// The substeps. blocks: at most those of the shape, for frame.solve_team.
core::Status launch_solve(const RigidFrameView& frame, std::uint32_t blocks, StreamHandle stream);

// Only where bodies may sleep: launch_wake after the contacts, launch_fall_asleep after the substeps.
core::Result<LaunchShape> sleep_launch_shape();
core::Status launch_wake(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream);
core::Status launch_fall_asleep(const RigidFrameView& frame, const LaunchShape& shape, StreamHandle stream);

// The digest of the last frame. Adds to *digest.
struct RigidDigestView {
  std::uint32_t body_count = 0;
  std::uint64_t confirmed_count = 0;
  std::uint64_t patch_count = 0;
  const core::RigidState* detected = nullptr;
  const core::RigidState* state = nullptr;
  const core::RigidMass* mass = nullptr;
  const core::Vec3* static_spin = nullptr;  // rad/s, of static bodies, as the scene gives it
  const core::Pair* confirmed = nullptr;
  const core::ContactPatch* patches = nullptr;
  const core::Vec3* impulses = nullptr;
  unsigned long long* digest = nullptr;
};
core::Status launch_rigid_digest(const RigidDigestView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
