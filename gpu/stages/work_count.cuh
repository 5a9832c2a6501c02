// How the stages report their work. In a frame the calls do nothing and cost nothing; where work is counted, they add
// it up.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

struct Uncounted {
  __device__ void tests(std::uint32_t) {}
  __device__ void node() {}
};

// The counts of one thread.
struct Counted {
  unsigned long long test_count = 0;
  unsigned long long node_count = 0;

  __device__ void tests(std::uint32_t more) { test_count += more; }
  __device__ void node() { ++node_count; }
};

}  // namespace broadside::gpu
