// Into how many parts each body's pairs are dealt, on the ring of stages/broad/body_ring.cuh.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::gpu {

// On a ring of `bodies`, each body is paired with those on the half that follows it. Returns how many shares of `share`
// places that makes.
BROADSIDE_HD std::uint32_t ring_shares(std::uint32_t bodies, std::uint32_t share) {
  return (bodies / 2 + share - 1) / share;
}

}  // namespace broadside::gpu
