// What the searches for a pair's nearest vertices have in common: the stack, the lower bound from boxes, the nearest of
// a warp.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/leftover_work.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// A stack in shared memory. An entry has three words; words of one kind lie side by side.
struct SearchStack {
  std::uint32_t* words = nullptr;
  std::uint32_t entries = 0;
  std::uint32_t stride = 0;  // words from one kind to the next

  __device__ std::uint32_t* a() const { return words; }
  __device__ std::uint32_t* b() const { return words + stride; }
  __device__ NodePair at(std::uint32_t k) const {
    return {words[k], words[stride + k], __uint_as_float(words[2 * stride + k])};
  }
  __device__ void put(std::uint32_t k, const NodePair& p) const {
    words[k] = p.a;
    words[stride + k] = p.b;
    words[2 * stride + k] = __float_as_uint(p.gap2);
  }
  // The part with the first `count` entries, and the part from an entry on.
  __device__ SearchStack first(std::uint32_t count) const { return {words, count, stride}; }
  __device__ SearchStack from(std::uint32_t first) const { return {words + first, entries - first, stride}; }
};

// How many pairs of nodes and of leaves a team of warps has left to look at.
struct TeamCounts {
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;

  __device__ bool any() const { return (nodes | leaves) != 0; }
};

constexpr std::uint32_t kBytesPerStackEntry = 12;

// Squared distance of two boxes in the arithmetic of core::squared_distance. Every operation of it rounds
// monotonically, so no vertex in one box and vertex in the other have a smaller rounded squared distance: vertices that
// are skipped because of it cannot be the nearest.
__device__ inline float squared_gap(const core::Box& a, const core::Box& b) {
  const auto gap = [](float a_min, float a_max, float b_min, float b_max) {
    return fmaxf(0.0F, fmaxf(a_min - b_max, b_min - a_max));
  };
  const core::Vec3 g{gap(a.min.x, a.max.x, b.min.x, b.max.x), gap(a.min.y, a.max.y, b.min.y, b.max.y),
                     gap(a.min.z, a.max.z, b.min.z, b.max.z)};
  return core::dot(g, g);
}

// The nearest of all lanes by core::is_nearer. It compares one word after another, and hardly ever needs more than the
// first.
__device__ inline core::Proximity warp_nearest(const core::Proximity& mine) {
  // Bits of non-negative floats have the order of their values.
  const std::uint32_t distance = __float_as_uint(mine.squared_distance_m2);
  bool is_first = distance == warp_min(distance);
  unsigned first = __ballot_sync(kFullWarp, is_first);
  const auto among = [&](std::uint32_t word) {
    const std::uint32_t least = warp_min(is_first ? word : 0xFFFFFFFFU);
    is_first = is_first && word == least;
    first = __ballot_sync(kFullWarp, is_first);
  };
  if ((first & (first - 1)) != 0) among(mine.vertex_a);
  if ((first & (first - 1)) != 0) among(mine.vertex_b);
  const int source = __ffs(static_cast<int>(first)) - 1;
  return {__shfl_sync(kFullWarp, mine.squared_distance_m2, source), __shfl_sync(kFullWarp, mine.vertex_a, source),
          __shfl_sync(kFullWarp, mine.vertex_b, source)};
}

}  // namespace broadside::gpu
