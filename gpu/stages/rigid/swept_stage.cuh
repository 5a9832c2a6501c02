// Bodies that move farther than they are thick stop before they pass through others. The same as
// reference/octree_cpu/rigid/sweep_stage.cpp.
#pragma once

#include "core/method/rigid/sweep.hpp"
#include "core/method/rigid/turned_box.hpp"
#include "gpu/rigid/swept_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/frame_marks.cuh"
#include "gpu/stages/rigid/warp_lanes.cuh"

namespace broadside::gpu {

__device__ inline core::SweptWay whole_way(const SweptView& s, std::uint32_t body) {
  const ContactView& f = s.bodies;
  core::SweptWay way;
  way.start = pose_of(f, body);
  way.end = {s.after[body].x, s.after[body].q};
  way.swing_m = core::swing_of(way.start, way.end, f.shapes[f.shape_of_body[body]].balls.outer_m);
  return way;
}

__device__ inline core::SweptWay way_of(const SweptView& s, std::uint32_t body) {
  return core::part_of_way(whole_way(s, body), s.parts[body]);
}

// A thread a body; a launch without a barrier.
__device__ inline void run_ways(const SweptView& s) {
  const GridPlaces grid;
  const ContactView& f = s.bodies;
  std::uint32_t longest = 0;
  for (std::uint64_t k = grid.rank(); k < f.body_count; k += grid.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    const RigidShapeView& shape = f.shapes[f.shape_of_body[i]];
    const core::SweptWay way = whole_way(s, i);
    const core::Box end = core::turned_box(shape.contact, shape.vertices, way.end.x, way.end.q);
    s.boxes[i] = core::box_of_way(f.shape_boxes[i], end, way.swing_m);
    s.length_m[i] = core::length_of(way);
    s.parts[i] = s.next_parts[i] = core::kPartsOfWay;
    s.is_changed[i] = 1;
    longest = max(longest, __float_as_uint(s.length_m[i]));
  }
  __syncwarp();
  longest = warp_max(longest);
  if (lane() == 0 && longest != 0) atomicMax(&s.counts->longest, longest);
}

// By a whole warp, like the functions below.
__device__ inline void lower_parts(const SweptView& s, std::uint32_t body, float share) {
  if (lane() != 0 || !(share < 1.0F)) return;
  atomicMin(&s.next_parts[body], static_cast<std::uint32_t>(share * static_cast<float>(s.parts[body])));
}

__device__ inline void shorten_pair(const SweptView& s, core::Pair pair) {
  const ContactView& f = s.bodies;
  if (!are_followed(f, pair) || (!is_moved(f, pair.i) && !is_moved(f, pair.j))) return;
  const float thin_m = thinner_m(f, pair);
  if (!core::moves_far(s.length_m[pair.i], s.length_m[pair.j], thin_m)) return;
  if (s.is_changed[pair.i] == 0 && s.is_changed[pair.j] == 0) return;
  if (s.parts[pair.i] == 0 && s.parts[pair.j] == 0) return;
  const float share = core::clear_share<WarpLanes>(f.shapes[f.shape_of_body[pair.i]].contact, way_of(s, pair.i),
                                                   f.shapes[f.shape_of_body[pair.j]].contact, way_of(s, pair.j),
                                                   core::swept_depth_m(thin_m), core::swept_done_m(thin_m));
  lower_parts(s, pair.i, share);
  lower_parts(s, pair.j, share);
}

__device__ inline void shorten_at_faces(const SweptView& s, std::uint32_t body) {
  const ContactView& f = s.bodies;
  const RigidShapeView& shape = f.shapes[f.shape_of_body[body]];
  const float thin_m = shape.half_thickness_m;
  if (f.is_swept[body] == 0 || !is_moved(f, body) || !(s.length_m[body] > core::swept_depth_m(thin_m))) return;
  if (s.is_changed[body] == 0 || s.parts[body] == 0) return;
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
    if (!core::may_reach_face(s.boxes[body], 0.0F, f.domain, face)) continue;
    const core::SweptWay still{f.face_poses[face], f.face_poses[face], 0.0F};
    lower_parts(s, body,
                core::clear_share<WarpLanes>(shape.contact, way_of(s, body), f.face_shapes[face], still,
                                             core::swept_depth_m(thin_m), core::swept_done_m(thin_m)));
  }
}

// A body goes the shortest way that any of its pairs allows.
template <typename Team>
__device__ void take_round(const Team& team, const SweptView& s, std::uint32_t round) {
  bool has_changed = false;
  for (std::uint64_t i = team.rank(); i < s.bodies.body_count; i += team.size()) {
    s.is_changed[i] = s.next_parts[i] < s.parts[i] ? 1 : 0;
    if (s.is_changed[i] == 0) continue;
    has_changed = true;
    if (round >= core::kMostSweepRounds) s.next_parts[i] = 0;
    s.parts[i] = s.next_parts[i];
  }
  if (has_changed) s.counts->has_changed[round % 3] = 1;
}

template <typename Team>
__device__ void draw_back(const Team& team, const SweptView& s) {
  for (std::uint64_t k = team.rank(); k < s.bodies.body_count; k += team.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    if (s.parts[i] == core::kPartsOfWay || !is_moved(s.bodies, i)) continue;
    const core::SweptWay gone = way_of(s, i);
    s.after[i].x = gone.end.x;
    s.after[i].q = gone.end.q;
    s.after[i].q_rest = {0.0F, 0.0F, 0.0F, 0.0F};
    atomicAdd(&s.counts->stopped, 1U);
  }
}

// Rounds over all pairs, a warp a pair, until nothing changes. The result is a function of the poses and does not
// depend on any order.
__device__ inline void run_stop_short(const SweptView& s) {
  const ContactView& f = s.bodies;
  const GridTeam grid(f.barrier);
  for (std::uint32_t round = 0;; ++round) {
    for (std::uint64_t k = grid.spread_rank() / 32; k < s.pair_count + f.body_count; k += grid.size() / 32) {
      if (k < s.pair_count)
        shorten_pair(s, s.pairs[k]);
      else
        shorten_at_faces(s, static_cast<std::uint32_t>(k - s.pair_count));
    }
    // No thread reads this word any more: the round that read it was two barriers ago.
    if (grid.rank() == 0) s.counts->has_changed[(round + 1) % 3] = 0;
    grid.sync();
    take_round(grid, s, round);
    grid.sync();
    if (s.counts->has_changed[round % 3] == 0) break;
  }
  draw_back(grid, s);
  grid.sync();
  // The response ends here; it includes contacts with faces.
  mark(f, grid.rank() == 0, core::Stage::kResponse);
  mark(f, grid.rank() == 0, core::Stage::kFaces);
}

}  // namespace broadside::gpu
