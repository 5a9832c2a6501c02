// Where the constraints of each color lie, and which of them a thread solves.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// The places of one color. A place belongs to the thread whose rank is the place modulo the number of threads. So a
// thread's constraints are spread over as many colors as possible, and it can load each of them long before that
// color's turn.
struct ColorPlaces {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t first_rank = 0;  // of the thread that has the first place
};

// In a block's shared memory, because every sweep reads it. Colors that do not fit are read from device memory.
struct ColorTable {
  static constexpr std::uint32_t kColors = 96;
  ColorPlaces of_color[kColors];
};

// threads: how many threads work on the color.
__device__ __forceinline__ ColorPlaces places_of_color(const RigidFrameView& f, std::uint32_t color,
                                                       std::uint32_t threads) {
  const std::uint32_t begin = f.color_begin[color];
  return {begin, begin + f.color_count[color], begin % threads};
}

}  // namespace broadside::gpu
