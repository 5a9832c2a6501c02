// The result of the vertex search of a pair in a small frame.
#pragma once

#include <cstdint>

#include "core/method/proximity.hpp"

namespace broadside::gpu {

// Other warps may test the pair's levels at the same time. If they reject the pair, `nearest` is meaningless.
struct alignas(16) MeasuredPair {
  core::Proximity nearest;
  std::uint32_t is_rejected = 0;
};
static_assert(sizeof(MeasuredPair) == 16, "read in one word");

}  // namespace broadside::gpu
