// A box in two 16-byte words, so that a thread reads it with two wide loads.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"

namespace broadside::gpu {

// The owner may use the tags for anything: a body's id, a level of the grid.
struct alignas(16) PackedBox {
  core::Vec3 min;
  std::uint32_t low_tag = 0;
  core::Vec3 max;
  std::uint32_t high_tag = 0;
};

static_assert(sizeof(PackedBox) == 32, "kernel parameter: host and device must agree on its layout");

BROADSIDE_HD PackedBox pack(const core::Box& box, std::uint32_t low_tag = 0, std::uint32_t high_tag = 0) {
  PackedBox packed;
  packed.min = box.min;
  packed.low_tag = low_tag;
  packed.max = box.max;
  packed.high_tag = high_tag;
  return packed;
}

BROADSIDE_HD core::Box unpack(const PackedBox& packed) {
  return {packed.min, packed.max};
}

// Three floats and a word: a position with the inverse mass, a velocity, a vertex with its index.
struct alignas(16) PackedVec3 {
  core::Vec3 v;
  float w = 0.0F;
};

static_assert(sizeof(PackedVec3) == 16, "kernel parameter: host and device must agree on its layout");

}  // namespace broadside::gpu
