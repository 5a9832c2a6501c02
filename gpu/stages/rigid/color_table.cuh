// Where the constraints of each color lie, and which of them are a thread's.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// Of one color. A place is the thread's whose rank is the rest of the place by the number of threads: so a thread has
// its constraints in as many different colors as can be, and loads each long before the turn of its color.
struct ColorPlaces {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t first_rank = 0;  // of who has the first place
};

// In a block's shared memory, since every sweep asks for it. Colors behind those that it holds are asked of the device.
struct ColorTable {
  static constexpr std::uint32_t kColors = 96;
  ColorPlaces of_color[kColors];
};

// threads: that work on the color.
__device__ __forceinline__ ColorPlaces places_of_color(const RigidFrameView& f, std::uint32_t color,
                                                       std::uint32_t threads) {
  const std::uint32_t begin = f.color_begin[color];
  return {begin, begin + f.color_count[color], begin % threads};
}

}  // namespace broadside::gpu
