// Applies impulses that are known beforehand to the bodies: a thread a body, which goes through its patches in the
// order of their colors, without a barrier. The bits are those of a sweep color by color, because such impulses do not
// depend on velocities and no two patches of a body have one color.
#pragma once

#include "core/method/rigid/conjugate_directions.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/constraint_tiles.cuh"

namespace broadside::gpu {

// A patch and which of its bodies this thread works for.
struct KnownPatch {
  core::PatchConstraint c;
  float changes[kFourPoints][3] = {};
  bool is_b = false;  // the body is the patch's B
};

// triples(slot, out) gives the changes of the normal and tangent impulses of the four points.
template <typename Triples>
__device__ __forceinline__ void give_known_impulses(const RigidFrameView& f, std::uint32_t i, core::SolverBody& body,
                                                    const Triples& triples) {
  const std::uint32_t* places = f.by_color + f.memory.begin[i];
  const std::uint32_t count = core::is_moved(body) ? f.memory.count[i] : 0;  // who sleeps is not moved
  const auto load = [&](std::uint32_t place_and_side) {
    const TileSlot slot(f.constraints, place_and_side / 2);
    KnownPatch known;
    known.is_b = place_and_side % 2 != 0;
    load_bodies(slot, known.c);
    load_centers(slot, load_directions(slot, known.c), known.c);
    load_levers(slot, known.c);
    triples(slot, known.changes);
    return known;
  };
  // A patch is loaded one round before it is used, and its place one round before that.
  KnownPatch ahead;
  std::uint32_t next = count > 0 ? places[0] : 0;
  for (std::uint32_t k = 0; k <= count; ++k) {
    const KnownPatch now = ahead;
    if (k < count) ahead = load(next);
    next = k + 1 < count ? places[k + 1] : 0;
    if (k == 0) continue;
    core::PatchPushOf<float> given;
    core::each_point(now.c, [&](int point) {
      const float(&change)[3] = now.changes[point];
      given.add_normal(now.c.points[point].lever, change[0]);
      given.add_tangents(now.c.points[point].lever, change[1], change[2]);
    });
    if (now.is_b)
      core::give_to_b(now.c, given, body);
    else
      core::give_to_a(now.c, given, body);
  }
}

// The impulses of the substep before: core::warm_start.
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

// A step along the last directions: core::push_along. since: only of patches that this relaxation has visited; 0 = of
// all, before the bodies move.
__device__ __forceinline__ void give_step_along(const RigidFrameView& f, std::uint32_t i, core::SolverBody& body,
                                                float share, std::uint32_t since) {
  give_known_impulses(f, i, body, [share, since](const TileSlot& slot, float(&out)[kFourPoints][3]) {
    float ways[kFourPoints][3] = {};
    if (since == 0 || load_relaxed(slot) == since) load_triples(slot, kWays, ways);
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
