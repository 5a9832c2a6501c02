// Starts a step: computes the swept box of each turned body, which contains all that the body can fill within the step,
// and all other values with which a step begins. RIGID 8.2 and 8.7.
#pragma once

#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/sleep.hpp"
#include "core/method/rigid/stride.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"

namespace broadside::gpu {

// A nonnegative float as a word is ordered like the float; a negative one, or NaN, is above all of them.
__device__ inline std::uint32_t as_ordered(float v) {
  return __float_as_uint(v);
}

__device__ inline core::RigidWrench wrench_of(const RigidFrameView& f, std::uint32_t body) {
  return f.wrench == nullptr ? core::RigidWrench{} : f.wrench[body];
}

// A thread a body; a launch of its own, without a barrier.
__device__ inline void run_place(const RigidFrameView& f) {
  const GridPlaces grid;
  if (grid.rank() == 0) {
    f.outcome->begin_ns = now_ns();
    begin_body(f, f.body_count, core::SolverBody{});
    f.starts[f.body_count] = {};
    f.stirred[f.body_count] = 0;
  }
  std::uint32_t side = 0;
  std::uint32_t coordinate = 0;
  std::uint32_t fastest = 0;
  std::uint32_t stride = 0;
  for (std::uint64_t k = grid.rank(); k < f.body_count; k += grid.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    const core::RigidState s = f.before[i];
    const core::RigidMass mass = f.mass[i];
    const RigidShapeView& shape = f.shapes[f.shape_of_body[i]];
    const core::RigidWrench wrench = wrench_of(f, i);
    const core::FreeMotion motion = core::free_motion(s, mass, shape.balls, f.gravity_m_s2, wrench, f.dt_s);
    const core::Box shape_box = core::turned_box(shape.contact, shape.vertices, s.x, s.q);
    const core::PushWord push = core::stronger_push(f.old_push[i], f.old_passed_on[i]);
    const std::uint32_t pusher = core::pusher_of(push);
    const core::Vec3 pushed = core::pushed_way(push, motion.drift, f.dt_s * f.before[pusher].v);
    const int steps = core::steps_ahead(motion, shape.half_thickness_m);
    const core::Box box = core::pushed_box(core::swept_box(shape_box, motion, steps), pushed);
    f.pushers[i] = {{motion.drift, motion.swing_m}, {pushed, __uint_as_float(pusher)}};
    f.push[i] = 0;
    f.passed_on[i] = 0;
    f.free_end[i] = core::free_end(s, mass, f.gravity_m_s2, wrench, f.dt_s);
    f.reach_m[i] = motion.reach_m() + core::length(pushed);
    f.fall_m[i] = core::length(motion.fall);
    f.pushed_m[i] = 0;
    f.memory.count[i] = 0;
    begin_body(f, i, is_asleep(f, i) ? core::SolverBody{} : core::solver_body(s, mass));
    if (f.asleep != nullptr) f.sleep.restless[i] = 0;
    f.stirred[i] = 0;
    f.relaxed[i] = 0;
    f.shape_boxes[i] = shape_box;
    if (mass.inverse_mass > 0.0F) {
      const float fastest_m_s = core::fastest_of_body_m_s(s, mass, shape.balls.outer_m);
      fastest = max(fastest, as_ordered(fastest_m_s));
      stride = max(stride, as_ordered(core::stride_of(fastest_m_s, shape.half_thickness_m, f.step_s)));
    }
    f.boxes[i] = pack(box, i, mass.inverse_mass > 0.0F ? 0U : 1U);
    for (int axis = 0; axis < 3; ++axis) {
      side = max(side, as_ordered(box.max[axis] - box.min[axis]));
      coordinate = max(coordinate, max(as_ordered(fabsf(box.min[axis])), as_ordered(fabsf(box.max[axis]))));
    }
  }
  __syncwarp();
  side = warp_max(side);
  coordinate = warp_max(coordinate);
  fastest = warp_max(fastest);
  stride = warp_max(stride);
  if (lane() != 0) return;
  if (side != 0) atomicMax(&f.counts->largest_side, side);
  if (coordinate != 0) atomicMax(&f.counts->largest_coordinate, coordinate);
  if (fastest != 0) atomicMax(&f.counts->fastest_m_s, fastest);
  if (stride != 0) atomicMax(&f.counts->stride, stride);
}

}  // namespace broadside::gpu
