// What impulses that are known beforehand do to the bodies: a thread a body, which takes its patches in the order of
// their colors. The bits are those of a sweep color by color, because such impulses do not depend on velocities, and a
// body has no two patches of one color; but there is no barrier.
#pragma once

#include "core/method/rigid/conjugate_directions.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/constraint_tiles.cuh"

namespace broadside::gpu {

// triples(slot, out): how far normal and tangent impulses of the four points change.
template <typename Triples>
__device__ __forceinline__ void give_known_impulses(const RigidFrameView& f, std::uint32_t i, core::SolverBody& body,
                                                    const Triples& triples) {
  const std::uint32_t* places = f.by_color + f.memory.begin[i];
  const std::uint32_t count = f.memory.count[i];
  std::uint32_t next = count > 0 ? places[0] : 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t own = next;
    next = k + 1 < count ? places[k + 1] : 0;
    const TileSlot slot(f.constraints, own / 2);
    const bool is_b = own % 2 != 0;
    core::PatchConstraint c;
    load_bodies(slot, c);
    load_arms(slot, load_directions(slot, c), c);
    float changes[kFourPoints][3];
    triples(slot, changes);
    core::BodyGain gain(body);
    core::each_point(c, [&](int point) {
      const core::PatchPoint& p = c.points[point];
      const core::Vec3 impulse = core::impulse_of(c, changes[point][0], changes[point][1], changes[point][2]);
      if (is_b)
        gain.add_to_b(body, p.arm_b, impulse);
      else
        gain.add_to_a(body, p.arm_a, impulse);
    });
    gain.store(body);
  }
}

// Those of the substep before: core::warm_start.
__device__ __forceinline__ void give_kept_impulses(const RigidFrameView& f, std::uint32_t i, core::SolverBody& body) {
  give_known_impulses(f, i, body, [](const TileSlot& slot, float(&out)[kFourPoints][3]) {
#pragma unroll
    for (std::uint32_t k = 0; k < kFourPoints; ++k) {
      const PackedVec3 impulse = slot.at(kImpulses + k);
      out[k][0] = impulse.v.x;
      out[k][1] = impulse.v.y;
      out[k][2] = impulse.v.z;
    }
  });
}

// A step along the last directions: core::push_along.
__device__ __forceinline__ void give_step_along(const RigidFrameView& f, std::uint32_t i, core::SolverBody& body,
                                                float share) {
  give_known_impulses(f, i, body, [share](const TileSlot& slot, float(&out)[kFourPoints][3]) {
    float ways[kFourPoints][3];
    load_triples(slot, kWays, ways);
#pragma unroll
    for (std::uint32_t k = 0; k < kFourPoints; ++k) {
      const core::PointStep step = core::step_along(ways[k], share);
      out[k][0] = step.normal;
      out[k][1] = step.tangent_1;
      out[k][2] = step.tangent_2;
    }
  });
}

}  // namespace broadside::gpu
