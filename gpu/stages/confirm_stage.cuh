// The body octrees of a pair of bodies, level by level; a warp per pair. METHOD section 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/team.cuh"
#include "gpu/stages/work_count.cuh"

namespace broadside::gpu {

struct PlacedShape {
  std::uint32_t shape = 0;
  const PackedBox* octree = nullptr;
  core::Vec3 x;
};

// `octrees`: of all shapes, wherever they are at hand.
__device__ inline PlacedShape placed_shape(const FrameView& f, const PackedBox* octrees, std::uint32_t body) {
  const std::uint32_t shape = f.shape_of_body[body];
  return {shape, octrees + std::uint64_t{shape} * core::kBodyOctreeNodes, f.detected.position[body].v};
}
__device__ inline PlacedShape placed_shape(const FrameView& f, std::uint32_t body) {
  return placed_shape(f, f.shapes.octree, body);
}

// Eight boxes of each body, as the lanes of a warp hold them: one of B, two of A.
struct EightByEight {
  static constexpr std::uint32_t kTestsOfLane = 2;

  core::Box b;
  core::Box low;
  core::Box high;

  __device__ EightByEight(const PackedBox* of_a, core::Vec3 xa, const PackedBox* of_b, core::Vec3 xb)
      : b(core::translated(unpack(of_b[lane() % 8]), xb)),
        low(core::translated(unpack(of_a[lane() / 8]), xa)),
        high(core::translated(unpack(of_a[lane() / 8 + 4]), xa)) {}

  // Of their 64 pairs, two a lane: bit 8 p + q for box p of A and q of B.
  __device__ std::uint64_t hits() const {
    const std::uint64_t low_hits = __ballot_sync(kFullWarp, core::overlaps(low, b));
    const std::uint64_t high_hits = __ballot_sync(kFullWarp, core::overlaps(high, b));
    return low_hits | high_hits << 32;
  }
};

__device__ inline EightByEight first_level(const PlacedShape& a, const PlacedShape& b) {
  return {a.octree + core::kLevelOffset[1], a.x, b.octree + core::kLevelOffset[1], b.x};
}

// The children of boxes p of A and q of B, which `bit` = 8 p + q of the first level's hits names.
__device__ inline EightByEight second_level(const PlacedShape& a, const PlacedShape& b, int bit) {
  return {a.octree + core::first_child(core::kLevelOffset[1] + bit / 8), a.x,
          b.octree + core::first_child(core::kLevelOffset[1] + bit % 8), b.x};
}

// core::descent_overlaps by a warp: empty boxes overlap nothing, so they need no care. So many of the first level's
// hits at a time: two where what takes the time is waiting for boxes, one where warps are many and hide each other's
// waits.
template <unsigned kAtOnce, typename Work>
__device__ bool descends(const PlacedShape& a, const PlacedShape& b, Work& work) {
  static_assert(kAtOnce == 1 || kAtOnce == 2);
  work.tests(EightByEight::kTestsOfLane);
  for (std::uint64_t hits = first_level(a, b).hits(); hits != 0;) {
    const int one = __ffsll(static_cast<long long>(hits)) - 1;
    hits &= hits - 1;
    work.tests(EightByEight::kTestsOfLane * kAtOnce);
    const EightByEight below_one = second_level(a, b, one);
    std::uint64_t below = 0;
    if constexpr (kAtOnce == 2) {
      const int other = hits != 0 ? __ffsll(static_cast<long long>(hits)) - 1 : one;
      hits &= hits - 1;
      below = second_level(a, b, other).hits();
    }
    if ((below | below_one.hits()) != 0) return true;
  }
  return false;
}

// core::level2_overlaps by a warp: all pairs, two boxes of A a lane against each box of B.
template <typename Work>
__device__ bool level2_meets(const FrameView& f, const PlacedShape& a, const PlacedShape& b, Work& work) {
  const PackedBox* boxes_a = f.shapes.level2 + std::uint64_t{a.shape} * core::kLevelSize[2];
  const PackedBox* boxes_b = f.shapes.level2 + std::uint64_t{b.shape} * core::kLevelSize[2];
  const std::uint32_t count_a = f.shapes.level2_count[a.shape];
  const std::uint32_t count_b = f.shapes.level2_count[b.shape];
  const core::Box none = core::empty_box();
  const core::Box low = lane() < count_a ? core::translated(unpack(boxes_a[lane()]), a.x) : none;
  const core::Box high = lane() + 32 < count_a ? core::translated(unpack(boxes_a[lane() + 32]), a.x) : none;
  work.tests(count_b * ((lane() < count_a ? 1U : 0U) + (lane() + 32 < count_a ? 1U : 0U)));
  bool hit = false;
#pragma unroll 4
  for (std::uint32_t q = 0; q < count_b; ++q) {
    const core::Box box = core::translated(unpack(boxes_b[q]), b.x);
    hit = hit || core::overlaps(low, box) || core::overlaps(high, box);
  }
  return __any_sync(kFullWarp, hit);
}

// core::is_confirmed by a warp, for the levels that have a first level below 0 or passed it already.
template <unsigned kAtOnce = 1, typename Work>
__device__ bool are_levels_overlapping(const FrameView& f, const PlacedShape& a, const PlacedShape& b, Work& work) {
  switch (f.levels) {
    case core::Levels::kFlat:
      return true;
    case core::Levels::kLevel1:
      work.tests(EightByEight::kTestsOfLane);
      return first_level(a, b).hits() != 0;
    case core::Levels::kA:
      return level2_meets(f, a, b, work);
    case core::Levels::kB:
    case core::Levels::kC:
      return descends<kAtOnce>(a, b, work);
  }
  return false;
}

// From pairs to confirmed. Each warp takes a run of pairs and appends what it confirms with one atomic; runs are short
// while there are more warps than pairs, so that few pairs are done at once.
template <typename Team, typename Work>
__device__ void confirm_pairs(const Team& team, const FrameView& f, Work& work) {
  const std::uint64_t count = f.counters->pairs;
  const std::uint64_t warps = warp_count(team);
  const std::uint64_t run = min(std::uint64_t{32}, (count + warps - 1) / warps);
  for (std::uint64_t first = warp_rank(team) * run; first < count; first += warps * run) {
    const std::uint64_t last = min(first + run, count);
    unsigned hits = 0;
    for (std::uint64_t k = first; k < last; ++k) {
      const core::Pair p = f.pairs.items[k];
      if (are_levels_overlapping(f, placed_shape(f, p.i), placed_shape(f, p.j), work)) hits |= 1U << (k - first);
    }
    const bool mine = ((hits >> lane()) & 1U) != 0;
    const unsigned long long place = warp_append(mine ? 1U : 0U, &f.counters->confirmed);
    if (mine && place < f.confirmed.capacity) f.confirmed.items[place] = f.pairs.items[first + lane()];
  }
}

}  // namespace broadside::gpu
