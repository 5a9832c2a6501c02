// What the searches for a pair's nearest vertices share: a warp's stack, the bound by boxes, the warp's verdict.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// One warp's stack in shared memory: three words an entry. A node of a tree is level << 28 | index.
struct SearchStack {
  std::uint32_t* a = nullptr;
  std::uint32_t* b = nullptr;
  std::uint32_t* c = nullptr;
};

constexpr std::uint32_t kBytesPerStackEntry = 12;

// Squared distance of two boxes in the arithmetic of core::squared_distance. Rounding is monotone in every operation of
// it, so no vertex in one box and vertex in the other have a smaller rounded squared distance than this: what is
// skipped by it could not have been the nearest.
__device__ inline float squared_gap(const core::Box& a, const core::Box& b) {
  const auto gap = [](float a_min, float a_max, float b_min, float b_max) {
    return fmaxf(0.0F, fmaxf(a_min - b_max, b_min - a_max));
  };
  const core::Vec3 g{gap(a.min.x, a.max.x, b.min.x, b.max.x), gap(a.min.y, a.max.y, b.min.y, b.max.y),
                     gap(a.min.z, a.max.z, b.min.z, b.max.z)};
  return core::dot(g, g);
}

__device__ inline core::Proximity warp_nearest(core::Proximity mine) {
  for (unsigned step = 16; step > 0; step /= 2) {
    core::Proximity other;
    other.squared_distance_m2 = __shfl_xor_sync(kFullWarp, mine.squared_distance_m2, step);
    other.vertex_a = __shfl_xor_sync(kFullWarp, mine.vertex_a, step);
    other.vertex_b = __shfl_xor_sync(kFullWarp, mine.vertex_b, step);
    if (core::is_nearer(other, mine)) mine = other;
  }
  return mine;
}

}  // namespace broadside::gpu
