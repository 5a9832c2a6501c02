// Confirms candidate pairs whose body-octree nodes overlap, in body axes; one thread for each pair. RIGID 8.3.
#pragma once

#include "core/method/rigid/oriented_levels.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/push_stage.cuh"
#include "gpu/stages/rigid/warp_shares.cuh"

namespace broadside::gpu {

__device__ inline bool levels_meet(const ContactView& f, core::Pair pair) {
  const RigidShapeView& a = f.shapes[f.shape_of_body[pair.i]];
  const RigidShapeView& b = f.shapes[f.shape_of_body[pair.j]];
  const core::RelativePose pose = core::relative_pose(pose_of(f, pair.i), a.balls.outer_m, pose_of(f, pair.j),
                                                      b.balls.outer_m, f.reach_m[pair.i] + f.reach_m[pair.j]);
  core::Uncounted tests;
  return core::is_confirmed(f.levels, *a.nodes, *b.nodes, pose, tests);
}

// Takes one of all n^2 ordered pairs, where no broad phase came before; false if it is no pair.
__device__ inline bool pair_of_all(const ContactView& f, std::uint64_t k, core::Pair& pair) {
  pair = {static_cast<std::uint32_t>(k / f.body_count), static_cast<std::uint32_t>(k % f.body_count)};
  // Bodies whose boxes of the whole step do not overlap are no pair.
  return pair.i < pair.j && core::overlaps(unpack(f.boxes[pair.i]), unpack(f.boxes[pair.j])) &&
         (f.mass[pair.i].inverse_mass > 0.0F || f.mass[pair.j].inverse_mass > 0.0F);
}

template <typename Team>
__device__ void confirm_pairs(const Team& team, const ContactView& f) {
  const std::uint64_t n =
      f.has_broad ? f.broad_counters->pairs : std::uint64_t{f.body_count} * std::uint64_t{f.body_count};
  each_item_by_warps(team, n, f.has_long_contacts, [&](std::uint64_t k, bool is_pair) {
    core::Pair pair;
    if (is_pair && f.has_broad) pair = f.pairs[k];
    if (is_pair && !f.has_broad) is_pair = pair_of_all(f, k, pair);
    if (is_pair) note_pushes(f, pair);
    const bool meets = is_pair && levels_meet(f, pair);
    const std::uint64_t place = warp_append_one(meets, &f.counts->confirmed);
    if (!meets || place >= f.confirmed.capacity) return;
    f.confirmed.items[place] = pair;
    atomicMax(&f.pushed_m[pair.i], __float_as_uint(f.reach_m[pair.j]));
    atomicMax(&f.pushed_m[pair.j], __float_as_uint(f.reach_m[pair.i]));
  });
}

}  // namespace broadside::gpu
