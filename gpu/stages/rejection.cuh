// How a pair that the levels reject while it is measured is told from the others: it has no place of its own among the
// confirmed yet, and asking for one would be waited for.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/stages/device.cuh"

namespace broadside::gpu {

// A vertex of B without one of A: no pair of vertices is like that.
__device__ inline core::Proximity rejection() {
  core::Proximity none;
  none.vertex_b = 0;
  return none;
}
__device__ inline bool is_rejection(const core::Proximity& p) {
  return !p.is_touching() && p.vertex_b == 0;
}

}  // namespace broadside::gpu
