// The list of a body's patches.
#pragma once

#include <cstdint>

#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// work(entry) for each, in their order. They are loaded four at a time: a loop that loads one after the other waits for
// each of them.
template <typename Work>
__device__ __forceinline__ void each_entry(const PatchMemory& memory, std::uint32_t body, const Work& work) {
  constexpr std::uint32_t kAtOnce = 4;
  const PatchEntry* entries = memory.entries + memory.begin[body];
  const std::uint32_t count = memory.count[body];
  for (std::uint32_t first = 0; first < count; first += kAtOnce) {
    PatchEntry loaded[kAtOnce];
#pragma unroll
    for (std::uint32_t k = 0; k < kAtOnce; ++k) loaded[k] = entries[min(first + k, count - 1)];
#pragma unroll
    for (std::uint32_t k = 0; k < kAtOnce; ++k)
      if (first + k < count) work(loaded[k]);
  }
}

}  // namespace broadside::gpu
