// A kernel without barriers that packs boxes which lie on the device, and measures them.
#pragma once

#include <cfloat>

#include "gpu/broad/pack_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// False for NaN too, since NaN fails every comparison.
__device__ inline bool is_sound_interval(float low, float high) {
  return low <= high && low >= -FLT_MAX && high <= FLT_MAX;
}

__device__ inline void note_box(const core::Box& box, std::uint32_t place, BoxMeasure& own) {
  for (int k = 0; k < 3; ++k) {
    if (!is_sound_interval(box.min[k], box.max[k])) own.first_bad = min(own.first_bad, place);
    const float magnitude = max(fabsf(box.min[k]), fabsf(box.max[k]));
    own.largest_side = max(own.largest_side, ordered_bits(box.max[k] - box.min[k]));
    own.coordinate_range = max(own.coordinate_range, ordered_bits(magnitude));
    own.low[k] = min(own.low[k], ordered_bits(box.min[k]));
    own.high[k] = max(own.high[k], ordered_bits(box.max[k]));
  }
}

// Called by whole warps. Atomics on one word wait for each other, some 2 ns each, and thousands of warps come at the
// same time. So a warp first looks whether it would change the word, and skips the atomic if not.
__device__ inline void add_least(std::uint32_t* to, std::uint32_t value) {
  const std::uint32_t least = warp_min(value);
  if (threadIdx.x % 32 == 0 && least < *static_cast<volatile std::uint32_t*>(to)) atomicMin(to, least);
}
__device__ inline void add_largest(std::uint32_t* to, std::uint32_t value) {
  const std::uint32_t largest = ~warp_min(~value);
  if (threadIdx.x % 32 == 0 && largest > *static_cast<volatile std::uint32_t*>(to)) atomicMax(to, largest);
}

// Adds what one thread has measured to the measure of all boxes.
__device__ inline void add_measure(const BoxMeasure& own, BoxMeasure& all) {
  add_least(&all.first_bad, own.first_bad);
  add_largest(&all.largest_side, own.largest_side);
  add_largest(&all.coordinate_range, own.coordinate_range);
  for (int k = 0; k < 3; ++k) {
    add_least(&all.low[k], own.low[k]);
    add_largest(&all.high[k], own.high[k]);
  }
}

__device__ inline core::Box given_box(const float* given, std::uint64_t which) {
  const float* g = given + 6 * which;
  return {{g[0], g[1], g[2]}, {g[3], g[4], g[5]}};
}

__device__ inline void run_gather(const GatherView& view) {
  const GridPlaces grid;
  for (std::uint64_t k = grid.rank(); k < view.count; k += grid.size())
    view.gathered[k] = given_box(view.given, view.which[k]);
}

__device__ inline void run_pack(const PackView& view) {
  const GridPlaces grid;
  BoxMeasure own;
  for (std::uint64_t i = grid.rank(); i < view.count; i += grid.size()) {
    const core::Box box = given_box(view.given, i);
    const auto place = static_cast<std::uint32_t>(i);
    note_box(box, place, own);
    view.packed[i] = pack(box, place, view.is_static[i] != 0 ? 1U : 0U);
  }
  add_measure(own, *view.measure);
}

}  // namespace broadside::gpu
