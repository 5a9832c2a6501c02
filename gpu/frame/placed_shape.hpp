// A body as searches see it: a shape at a place, since bodies only translate.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/levels.hpp"

namespace broadside::gpu {

struct alignas(16) PlacedShape {
  core::Vec3 x;
  std::uint32_t shape = 0;

  // The first box of its octree among those of all shapes.
  BROADSIDE_HD std::uint32_t first_box() const { return shape * core::kBodyOctreeNodes; }
};

// The two bodies of a pair, in its order.
struct PlacedPair {
  PlacedShape i;
  PlacedShape j;
};
static_assert(sizeof(PlacedPair) == 32, "read in words of 16 bytes");

}  // namespace broadside::gpu
