// How many parts each body's pairs are dealt in: the ring is that of stages/broad/body_ring.cuh.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::gpu {

// Of `bodies` on a ring, each is paired with those on the half behind it: in so many shares of `share` places.
BROADSIDE_HD std::uint32_t ring_shares(std::uint32_t bodies, std::uint32_t share) {
  return (bodies / 2 + share - 1) / share;
}

}  // namespace broadside::gpu
