// Integrates the bodies of a small frame and tests all their pairs: METHOD sections 1 and 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/broad/body_ring.cuh"
#include "gpu/stages/grid/stage_clock.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/confirm_stage.cuh"
#include "gpu/stages/levels/shapes_in_block.cuh"
#include "gpu/stages/small_counts.cuh"

namespace broadside::gpu {

// The place of a pair that goes to no list.
constexpr std::uint32_t kNoPlace = 0xFFFFFFFFU;

// The items of the ring that a warp takes one after another: a body and those that it is paired with, a lane each.
class RingItem {
 public:
  __device__ RingItem(const GridPlaces& team, const SmallFrameView& f)
      : ring_(f.body_count, f.ring_share, FloatDivisor(ring_shares(f.body_count, f.ring_share))),
        item_(static_cast<std::uint32_t>(team.spread_rank() / 32)),
        stride_(static_cast<std::uint32_t>(warp_count(team))) {
    enter();
  }

  __device__ bool exists() const { return item_ < ring_.items(); }
  __device__ void next() {
    item_ += stride_;
    enter();
  }
  __device__ const BodyRing<FloatDivisor>::RingPair& pair() const { return pair_; }

 private:
  __device__ void enter() {
    if (exists()) pair_ = ring_.pair_of(item_);
  }

  BodyRing<FloatDivisor> ring_;
  std::uint32_t item_;
  std::uint32_t stride_;
  BodyRing<FloatDivisor>::RingPair pair_;
};

// Called by a whole warp for a pair that level 0 found.
__device__ inline bool is_confirmed_by_levels(const SmallFrameView& f, const ShapesInBlock& shapes,
                                              const PlacedShape& a, const PlacedShape& b) {
  Uncounted work;
  if (!shapes.has_octrees()) return are_levels_overlapping<2>(f, OctreesInMemory{f.shapes.octree}, a, b, work);
  shapes.wait();
  return are_levels_overlapping<2>(f, shapes, a, b, work);
}

// Tests level 0 for the pairs of an item, whose bodies are given as they were before the frame. If levels come first,
// it tests the levels below 0 too; if not, it confirms no pair yet.
__device__ inline void find_small_pairs(const SmallFrameView& f, const ShapesInBlock& shapes,
                                        const BodyRing<FloatDivisor>::RingPair& at, const BodyBefore& before_i,
                                        const BodyBefore& before_j) {
  const BodyAtDetection now_i(f, at.i, before_i);
  const BodyAtDetection now_j(f, at.j, before_j);
  const PlacedShape placed_i{now_i.state.x, shape_of(f, at.i)};
  const PlacedShape placed_j{now_j.state.x, shape_of(f, at.j)};
  const bool overlaps =
      at.exists && core::overlaps(now_i.box, now_j.box) && !(before_i.is_static() && before_j.is_static());
  const unsigned found = __ballot_sync(kFullWarp, overlaps);
  if (found == 0) return;
  unsigned confirmed = 0;
  for (unsigned left = f.are_levels_first ? found : 0U; left != 0; left &= left - 1) {
    const int source = __ffs(static_cast<int>(left)) - 1;
    const PlacedShape other{{__shfl_sync(kFullWarp, placed_j.x.x, source), __shfl_sync(kFullWarp, placed_j.x.y, source),
                             __shfl_sync(kFullWarp, placed_j.x.z, source)},
                            __shfl_sync(kFullWarp, placed_j.shape, source)};
    if (is_confirmed_by_levels(f, shapes, placed_i, other)) confirmed |= 1U << source;
  }
  const SmallCounts here{static_cast<std::uint32_t>(__popc(found)), static_cast<std::uint32_t>(__popc(confirmed))};
  const unsigned long long room = add_by_first_lane(f.barrier, here.packed());
  const SmallCounts first = SmallCounts::unpacked(__shfl_sync(kFullWarp, room, 0));
  const core::Pair pair = core::make_pair_of(at.i, at.j);
  const auto place_among = [](unsigned lanes, std::uint32_t begin) {
    return (lanes >> lane() & 1U) != 0 ? begin + __popc(lanes & ((1U << lane()) - 1U)) : kNoPlace;
  };
  const std::uint32_t place = place_among(found, first.pairs);
  if (place < f.pairs.capacity) f.pairs.items[place] = pair;
  const std::uint32_t confirmed_place = place_among(confirmed, first.judged);
  if (confirmed_place < f.confirmed.capacity) f.confirmed.items[confirmed_place] = pair;
  const std::uint32_t measured_place = f.are_levels_first ? confirmed_place : place;
  if (f.has_vertex_stage && measured_place < f.confirmed.capacity)
    f.placed[measured_place] = at.i == pair.i ? PlacedPair{placed_i, placed_j} : PlacedPair{placed_j, placed_i};
}

// Integrates bodies and finds pairs with no barrier between: a warp that tests a pair integrates both bodies itself.
// After an aborted frame it does nothing and returns false. `item`: the warp's first.
__device__ inline bool integrate_and_find_pairs(const GridTeam& team, const SmallFrameView& f,
                                                const ShapesInBlock& shapes, RingItem item) {
  const std::uint32_t is_aborted = is_behind_aborted(f);
  const std::uint64_t first = first_body(team);
  // All of this is loaded before any of it is used, so that the warp waits once.
  BodyBefore own;
  BodyBefore before_i;
  BodyBefore before_j;
  if (__any_sync(kFullWarp, first < f.body_count))
    own = BodyBefore(f, static_cast<std::uint32_t>(min(first, std::uint64_t{f.body_count} - 1)));
  if (item.exists()) {
    before_i = BodyBefore(f, item.pair().i);
    before_j = BodyBefore(f, item.pair().j);
  }
  group_loads();
  if (is_aborted != 0) return false;
  for (std::uint64_t i = first; i < f.body_count; i += team.size()) {
    const auto body = static_cast<std::uint32_t>(i);
    if (i != first) own = BodyBefore(f, body);
    start_body(f, body, own, BodyAtDetection(f, body, own));
  }
  if (team.rank() == 0) *f.counters = Counters{};
  mark_end(team, f.outcome, core::Stage::kIntegrate);
  shapes.begin_upper(f);
  // The warp that copies shapes has set up the copies before this.
  if (f.are_levels_first) __syncthreads();
  while (item.exists()) {
    find_small_pairs(f, shapes, item.pair(), before_i, before_j);
    item.next();
    if (!item.exists()) break;
    before_i = BodyBefore(f, item.pair().i);
    before_j = BodyBefore(f, item.pair().j);
    group_loads();
  }
  return true;
}

// Tests levels that do not come first: warps of teams that have no pair do it while other teams search vertices.
class SmallLevels {
 public:
  static constexpr bool kIsSmallFrame = true;
  using View = SmallFrameView;

  __device__ SmallLevels(const SmallFrameView& f, const ShapesInBlock& shapes) : f_(f), shapes_(shapes) {}

  // Copies the octrees. One warp calls both: begin() before a warp of the block calls look(), end() before the warp
  // itself ends.
  __device__ void begin() const { shapes_.begin_octrees(f_); }
  __device__ void end() const { shapes_.end_octrees(); }

  // Called by a warp. Stores whether the levels reject pair k, and returns whether they keep it.
  __device__ bool look(const PlacedPair& bodies, std::uint64_t k) const {
    const bool is_kept = is_confirmed_by_levels(f_, shapes_, bodies.i, bodies.j);
    if (lane() == 0) f_.measured[k].is_rejected = is_kept ? 0 : 1;
    if (!is_kept && lane() == 0) atomicAdd(f_.barrier, SmallCounts{0, 1}.packed());
    return is_kept;
  }

 private:
  const SmallFrameView& f_;
  const ShapesInBlock& shapes_;
};

}  // namespace broadside::gpu
