// What a block of the solver keeps in shared memory.
#pragma once

#include <cstdint>

#include "gpu/stages/rigid/color_table.cuh"

namespace broadside::gpu {

struct SolveShared {
  static constexpr std::uint32_t kMostWarps = 4;
  static constexpr std::uint32_t kChosen = 256;

  ColorTable colors;
  // By warp: the places that it visits next (chosen_turns.cuh).
  std::uint32_t chosen[kMostWarps][kChosen];
};

}  // namespace broadside::gpu
