// The launch that packs boxes which lie on the device, and measures them for the host, which never sees them.
#pragma once

#include <bit>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/result.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// Maps floats to integers of the same order, so that integer atomics find the least and the largest.
BROADSIDE_HD constexpr std::uint32_t ordered_bits(float v) {
  const auto bits = std::bit_cast<std::uint32_t>(v);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}
BROADSIDE_HD constexpr float from_ordered_bits(std::uint32_t bits) {
  return std::bit_cast<float>((bits & 0x80000000U) != 0 ? bits & 0x7FFFFFFFU : ~bits);
}

// Measures of all boxes together. They are minima and maxima, so the order of threads does not matter.
struct BoxMeasure {
  std::uint32_t first_bad = 0xFFFFFFFFU;  // the first box that is not finite or has min > max
  std::uint32_t largest_side = 0;         // ordered bits, like the others; 0 is below every number
  std::uint32_t coordinate_range = 0;
  std::uint32_t low[3] = {0xFFFFFFFFU, 0xFFFFFFFFU, 0xFFFFFFFFU};
  std::uint32_t high[3] = {};
};

struct PackView {
  std::uint32_t count = 0;
  const float* given = nullptr;             // [count][6]
  const std::uint8_t* is_static = nullptr;  // [count]
  PackedBox* packed = nullptr;              // [count], as pairs_kernel.cu reads them
  BoxMeasure* measure = nullptr;            // as BoxMeasure{} before the launch
};

// Copies some of the boxes to consecutive places.
struct GatherView {
  std::uint32_t count = 0;
  const std::uint32_t* which = nullptr;  // [count]
  const float* given = nullptr;          // boxes, as in PackView
  core::Box* gathered = nullptr;         // [count]
};

// Asynchronous.
core::Status launch_pack(const PackView& view, StreamHandle stream);
core::Status launch_gather(const GatherView& view, StreamHandle stream);

}  // namespace broadside::gpu
