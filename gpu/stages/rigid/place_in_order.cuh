// Where a patch stands among those of one of its bodies, which are solved in the order of their colors.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

class PlaceInOrder {
 public:
  __device__ explicit PlaceInOrder(std::uint32_t word = 0) : word_(word) {}
  __device__ PlaceInOrder(std::uint32_t before, bool is_last) : word_(2 * before + (is_last ? 1 : 0)) {}
  [[nodiscard]] __device__ std::uint32_t word() const { return word_; }
  [[nodiscard]] __device__ std::uint32_t before() const { return word_ / 2; }  // how many
  [[nodiscard]] __device__ bool is_last() const { return word_ % 2 != 0; }

 private:
  std::uint32_t word_;
};

// Of a patch's two bodies.
struct PatchOrder {
  PlaceInOrder of_a;
  PlaceInOrder of_b;
};

}  // namespace broadside::gpu
