// What the stages tell of their work: nothing at no cost in a frame, and sums where it is counted.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

struct Uncounted {
  __device__ void tests(std::uint32_t) {}
  __device__ void node() {}
};

// One thread's share.
struct Counted {
  unsigned long long test_count = 0;
  unsigned long long node_count = 0;

  __device__ void tests(std::uint32_t more) { test_count += more; }
  __device__ void node() { ++node_count; }
};

}  // namespace broadside::gpu
