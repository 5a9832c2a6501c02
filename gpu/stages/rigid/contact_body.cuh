// What stages ask of a turning body.
#pragma once

#include "core/contact.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

__device__ inline core::ContactPose pose_of(const ContactView& f, std::uint32_t body) {
  return {f.before[body].x, f.before[body].q};
}

__device__ inline bool is_moved(const ContactView& f, std::uint32_t body) {
  return !core::is_face(body) && f.mass[body].inverse_mass > 0.0F;
}

}  // namespace broadside::gpu
