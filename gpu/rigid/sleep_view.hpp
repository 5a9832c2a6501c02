// The data of the kernels of sleep (core/method/rigid/sleep.hpp), by value, of one simulation.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"
#include "core/method/rigid/manifold.hpp"
#include "gpu/rigid/contact_view.hpp"

namespace broadside::gpu {

// A patch of a sleeping body, with the impulses of the last step in which it was awake.
struct AsleepPatch {
  core::ContactPatch patch;
  core::Vec3 impulses[core::kManifoldPoints];         // N s on A, of the whole step
  std::uint32_t feature[core::kManifoldPoints] = {};  // as PatchMemory has them
  PackedVec3 remembered[core::kManifoldPoints] = {};
};

struct SleepView {
  float speed_m_s = 0.0F;             // below which a body is still; 0: no body sleeps
  bool decides = true;                // bodies may fall asleep: in the last part of a step
  float share = 1.0F;                 // impulses of sleeping contacts in this part over those in the part before
  std::uint32_t* still = nullptr;     // [bodies] steps in a row
  std::uint32_t* island = nullptr;    // [bodies] of a sleeping body: the lowest body of its island
  std::uint32_t* parent = nullptr;    // [bodies] union-find over the patches of a step
  std::uint32_t* restless = nullptr;  // [bodies] 1: the island with this lowest body wakes, or does not sleep yet
  const AsleepPatch* old = nullptr;   // those that slept when the step began
  std::uint64_t old_count = 0;
  AppendView<AsleepPatch> now;  // those that sleep when it ends
};

}  // namespace broadside::gpu
