// Tests the body octrees of a pair of bodies level by level, with a warp for each pair. METHOD section 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/placed_shape.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/work_count.cuh"

namespace broadside::gpu {

// Where the boxes of all shapes' octrees are. Stages that descend take any class with this at(), whose data must be
// there.
struct OctreesInMemory {
  const PackedBox* boxes;

  __device__ void wait() const {}
  __device__ core::Box at(std::uint32_t k) const { return fetched(boxes + k); }
};

// Which of 64 pairs overlap: bit 8 p + q for box p of A and q of B.
struct EightByEightHits {
  unsigned low = 0;   // bits 0 to 31
  unsigned high = 0;  // bits 32 to 63

  __device__ bool any() const { return (low | high) != 0; }
  __device__ friend EightByEightHits operator|(const EightByEightHits& p, const EightByEightHits& q) {
    return {p.low | q.low, p.high | q.high};
  }
  // Removes the lowest set bit and returns its number; 63 if there is none.
  __device__ std::uint32_t take() {
    const bool is_low = low != 0;
    const std::uint32_t bit = static_cast<std::uint32_t>(__ffs(static_cast<int>(is_low ? low : high)) - 1) % 32;
    high &= is_low ? ~0U : high - 1;
    low &= low - 1;
    return is_low ? bit : bit + 32;
  }
};

// Eight boxes of each of two bodies, held by the lanes of a warp: each lane has one of B and two of A.
struct EightByEight {
  static constexpr std::uint32_t kTestsOfLane = 2;

  core::Box b;
  core::Box low;
  core::Box high;

  // Takes eight boxes of each body, from these two on.
  template <typename Octrees>
  __device__ EightByEight(const Octrees& octrees, std::uint32_t of_a, core::Vec3 xa, std::uint32_t of_b, core::Vec3 xb)
      : b(core::translated(octrees.at(of_b + lane() % 8), xb)),
        low(core::translated(octrees.at(of_a + lane() / 8), xa)),
        high(core::translated(octrees.at(of_a + lane() / 8 + 4), xa)) {}

  __device__ EightByEightHits hits() const {
    return {__ballot_sync(kFullWarp, core::overlaps(low, b)), __ballot_sync(kFullWarp, core::overlaps(high, b))};
  }
};

template <typename Octrees>
__device__ EightByEight first_level(const Octrees& octrees, const PlacedShape& a, const PlacedShape& b) {
  constexpr std::uint32_t kFirst = core::kLevelOffset[1];
  return {octrees, a.first_box() + kFirst, a.x, b.first_box() + kFirst, b.x};
}

// The children of boxes p of A and q of B, where `bit` = 8 p + q is one of the first level's hits.
template <typename Octrees>
__device__ EightByEight second_level(const Octrees& octrees, const PlacedShape& a, const PlacedShape& b,
                                     std::uint32_t bit) {
  constexpr std::uint32_t kFirst = core::first_child(core::kLevelOffset[1]);
  return {octrees, a.first_box() + kFirst + bit / 8 * 8, a.x, b.first_box() + kFirst + bit % 8 * 8, b.x};
}

// core::descent_overlaps by a warp. Empty boxes overlap nothing, so they need no test of their own. kAtOnce of the
// first level's hits are descended at a time: two if waiting for boxes takes the time, one if other warps hide that
// wait.
template <unsigned kAtOnce, typename Octrees, typename Work>
__device__ bool descends(const Octrees& octrees, const PlacedShape& a, const PlacedShape& b, Work& work) {
  static_assert(kAtOnce == 1 || kAtOnce == 2);
  work.tests(EightByEight::kTestsOfLane);
  for (EightByEightHits hits = first_level(octrees, a, b).hits(); hits.any();) {
    work.tests(EightByEight::kTestsOfLane * kAtOnce);
    const EightByEight one = second_level(octrees, a, b, hits.take());
    if constexpr (kAtOnce == 2) {
      // If there is no second hit, the children of box pair 63 are tested instead, which is harmless: they overlap only
      // if their parents do.
      const EightByEight other = second_level(octrees, a, b, hits.take());
      if ((one.hits() | other.hits()).any()) return true;
    } else if (one.hits().any()) {
      return true;
    }
  }
  return false;
}

// core::level2_overlaps by a warp: tests all pairs, with two boxes of A in each lane against one box of B after
// another.
template <typename Work>
__device__ bool level2_overlaps(const FrameView& f, const PlacedShape& a, const PlacedShape& b, Work& work) {
  const PackedBox* boxes_a = f.shapes.level2 + std::uint64_t{a.shape} * core::kLevelSize[2];
  const PackedBox* boxes_b = f.shapes.level2 + std::uint64_t{b.shape} * core::kLevelSize[2];
  const std::uint32_t count_a = f.shapes.level2_count[a.shape];
  const std::uint32_t count_b = f.shapes.level2_count[b.shape];
  const core::Box none = core::empty_box();
  const core::Box low = lane() < count_a ? core::translated(fetched(boxes_a + lane()), a.x) : none;
  const core::Box high = lane() + 32 < count_a ? core::translated(fetched(boxes_a + lane() + 32), a.x) : none;
  work.tests(count_b * ((lane() < count_a ? 1U : 0U) + (lane() + 32 < count_a ? 1U : 0U)));
  bool hit = false;
#pragma unroll 4
  for (std::uint32_t q = 0; q < count_b; ++q) {
    const core::Box box = core::translated(fetched(boxes_b + q), b.x);
    hit = hit || core::overlaps(low, box) || core::overlaps(high, box);
  }
  return __any_sync(kFullWarp, hit);
}

// core::is_confirmed by a warp, for pairs whose level 0 was tested already or for levels that begin below it.
template <unsigned kAtOnce, typename Octrees, typename Work>
__device__ bool are_levels_overlapping(const FrameView& f, const Octrees& octrees, const PlacedShape& a,
                                       const PlacedShape& b, Work& work) {
  switch (f.levels) {
    case core::Levels::kFlat:
      return true;
    case core::Levels::kLevel1:
      work.tests(EightByEight::kTestsOfLane);
      return first_level(octrees, a, b).hits().any();
    case core::Levels::kA:
      return level2_overlaps(f, a, b, work);
    case core::Levels::kB:
    case core::Levels::kC:
      return descends<kAtOnce>(octrees, a, b, work);
  }
  return false;
}

// The same for these two bodies.
template <typename Work>
__device__ bool are_levels_overlapping(const FrameView& f, core::Pair p, Work& work) {
  return are_levels_overlapping<1>(f, OctreesInMemory{f.shapes.octree}, placed_shape(f, p.i), placed_shape(f, p.j),
                                   work);
}

// Confirms pairs. Each warp takes a run of pairs and appends those that it confirms with one atomic. If pairs are few,
// runs are short, so that all pairs are tested at the same time.
template <typename Team, typename Work>
__device__ void confirm_pairs(const Team& team, const FrameView& f, Work& work) {
  const std::uint64_t count = f.counters->pairs;
  const std::uint64_t warps = warp_count(team);
  const std::uint64_t run = min(std::uint64_t{32}, (count + warps - 1) / warps);
  for (std::uint64_t first = warp_rank(team) * run; first < count; first += warps * run) {
    const std::uint64_t last = min(first + run, count);
    unsigned hits = 0;
    for (std::uint64_t k = first; k < last; ++k) {
      if (are_levels_overlapping(f, f.pairs.items[k], work)) hits |= 1U << (k - first);
    }
    const bool mine = ((hits >> lane()) & 1U) != 0;
    const unsigned long long place = warp_append(mine ? 1U : 0U, &f.counters->confirmed);
    if (mine && place < f.confirmed.capacity) f.confirmed.items[place] = f.pairs.items[first + lane()];
  }
}

}  // namespace broadside::gpu
