// Facts of a turning body that several stages ask for.
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

__device__ inline bool is_asleep(const ContactView& f, std::uint32_t body) {
  return f.asleep != nullptr && !core::is_face(body) && f.asleep[body] != 0;
}

// Whether the body is idle: only a touch of a body that is not idle can move it.
__device__ inline bool is_idle(const ContactView& f, std::uint32_t body) {
  return !is_moved(f, body) || is_asleep(f, body);
}

// Whether the sweep keeps two bodies from passing through each other (core::RigidBodies). Only where f.follows_ways.
__device__ inline bool are_followed(const ContactView& f, core::Pair pair) {
  return f.is_swept[pair.i] != 0 || f.is_swept[pair.j] != 0;
}

// Half of the least thickness of the thinner body.
__device__ inline float thinner_m(const ContactView& f, core::Pair pair) {
  const float a = f.shapes[f.shape_of_body[pair.i]].half_thickness_m;
  const float b = f.shapes[f.shape_of_body[pair.j]].half_thickness_m;
  return b < a ? b : a;
}

}  // namespace broadside::gpu
