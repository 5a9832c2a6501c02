// What comes of a pair of few bodies while it is measured.
#pragma once

#include <cstdint>

#include "core/method/proximity.hpp"

namespace broadside::gpu {

// Its levels may be gone down meanwhile: of a rejected one `nearest` says nothing.
struct alignas(16) MeasuredPair {
  core::Proximity nearest;
  std::uint32_t is_rejected = 0;
};
static_assert(sizeof(MeasuredPair) == 16, "read in one word");

}  // namespace broadside::gpu
