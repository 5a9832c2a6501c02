// All pairs of a few bodies. METHOD section 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/body_ring.cuh"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/few_counts.cuh"
#include "gpu/stages/shapes_in_block.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// In no list.
constexpr std::uint32_t kNoPlace = 0xFFFFFFFFU;

// A warp's first item, and what of it does not move: known before the bodies do.
struct FewStart {
  BodyRing<std::uint32_t> ring;
  std::uint32_t item = 0;
  BodyRing<std::uint32_t>::Meeting meeting;
  std::uint32_t shape_i = 0;
  std::uint32_t shape_j = 0;

  __device__ FewStart(const GridTeam& team, const FrameView& f)
      : ring(f.body_count, f.ring_share), item(static_cast<std::uint32_t>(team.spread_rank() / 32)) {
    if (item < ring.items()) enter(f);
  }

  __device__ bool next(const FrameView& f, std::uint32_t stride) {
    item += stride;
    if (item >= ring.items()) return false;
    enter(f);
    return true;
  }

 private:
  __device__ void enter(const FrameView& f) {
    meeting = ring.meeting(item);
    shape_i = shape_of(f, meeting.i);
    shape_j = shape_of(f, meeting.j);
  }
};

// By a whole warp, of a pair that level 0 found.
__device__ inline bool is_confirmed_few(const FrameView& f, const ShapesInBlock& shapes, const PlacedShape& a,
                                        const PlacedShape& b) {
  Uncounted work;
  if (!shapes.has_octrees()) return are_levels_overlapping<2>(f, OctreesInMemory{f.shapes.octree}, a, b, work);
  shapes.wait();
  return are_levels_overlapping<2>(f, shapes, a, b, work);
}

// Level 0, and the levels below it where they come first; otherwise nothing is confirmed yet.
__device__ inline void find_few(const GridTeam& team, const FrameView& f, FewStart at, const ShapesInBlock& shapes) {
  if (at.item >= at.ring.items()) return;
  const auto stride = static_cast<std::uint32_t>(warp_count(team));
  do {
    // Everything is asked for before any of it is looked at: one wait.
    const PackedBox box_i = f.boxes[at.meeting.i];
    const PackedBox box_j = f.boxes[at.meeting.j];
    const PlacedShape placed_i{f.detected.position[at.meeting.i].v, at.shape_i};
    const PlacedShape placed_j{f.detected.position[at.meeting.j].v, at.shape_j};
    const bool overlaps =
        at.meeting.exists && core::overlaps(unpack(box_i), unpack(box_j)) && (box_i.high_tag & box_j.high_tag) == 0;
    const unsigned found = __ballot_sync(kFullWarp, overlaps);
    if (found == 0) continue;
    unsigned confirmed = 0;
    for (unsigned left = f.are_levels_first ? found : 0U; left != 0; left &= left - 1) {
      const int source = __ffs(static_cast<int>(left)) - 1;
      const PlacedShape other{
          {__shfl_sync(kFullWarp, placed_j.x.x, source), __shfl_sync(kFullWarp, placed_j.x.y, source),
           __shfl_sync(kFullWarp, placed_j.x.z, source)},
          __shfl_sync(kFullWarp, placed_j.shape, source)};
      if (is_confirmed_few(f, shapes, placed_i, other)) confirmed |= 1U << source;
    }
    const FewCounts here{static_cast<std::uint32_t>(__popc(found)), static_cast<std::uint32_t>(__popc(confirmed))};
    const unsigned long long room = add_by_first_lane(f.barrier, here.packed());
    const FewCounts first = FewCounts::unpacked(__shfl_sync(kFullWarp, room, 0));
    const core::Pair pair = core::make_pair_of(at.meeting.i, at.meeting.j);
    const auto place_among = [](unsigned lanes, std::uint32_t begin) {
      return (lanes >> lane() & 1U) != 0 ? begin + __popc(lanes & ((1U << lane()) - 1U)) : kNoPlace;
    };
    const std::uint32_t place = place_among(found, first.pairs);
    if (place < f.pairs.capacity) f.pairs.items[place] = pair;
    if (are_levels_left(f) && place < f.confirmed.capacity) f.measured[place] = MeasuredPair{};
    const std::uint32_t confirmed_place = place_among(confirmed, first.confirmed);
    if (confirmed_place < f.confirmed.capacity) f.confirmed.items[confirmed_place] = pair;
    const std::uint32_t measured_place = f.are_levels_first ? confirmed_place : place;
    if (measured_place < f.confirmed.capacity)
      f.placed[measured_place] =
          at.meeting.i == pair.i ? PlacedPair{placed_i, placed_j} : PlacedPair{placed_j, placed_i};
  } while (at.next(f, stride));
}

// The levels of few bodies' pairs where they do not come first: gone down by warps of teams that have no pair, while
// others measure the pairs.
class FewLevels {
 public:
  static constexpr bool kAreOfFewBodies = true;

  __device__ FewLevels(const FrameView& f, const ShapesInBlock& shapes) : f_(f), shapes_(shapes) {}

  // Before the first look(), by all threads of the block, which meets between the two; and when all are done.
  __device__ void begin() const { shapes_.begin_octrees(f_); }
  __device__ void end() const { shapes_.end_octrees(); }

  // By a warp: pair k is told to be rejected if it is. Returns whether it is not.
  __device__ bool look(const PlacedPair& bodies, std::uint64_t k) const {
    const bool is_kept = is_confirmed_few(f_, shapes_, bodies.i, bodies.j);
    if (!is_kept && lane() == 0) f_.measured[k].is_rejected = 1;
    return is_kept;
  }

  // Of those who measure pair k meanwhile: not 0 when somebody has told that it is rejected.
  __device__ std::uint32_t is_told_to_be_rejected(std::uint64_t k) const {
    return load_fresh_if(are_levels_left(f_), &f_.measured[k].is_rejected);
  }

 private:
  const FrameView& f_;
  const ShapesInBlock& shapes_;
};

}  // namespace broadside::gpu
