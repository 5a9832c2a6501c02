// Loads boxes and vertices from memory as whole words.
#pragma once

#include "core/math/box.hpp"
#include "gpu/frame/leftover_work.hpp"
#include "gpu/frame/measured_pair.hpp"
#include "gpu/frame/placed_shape.hpp"
#include "gpu/scene/packed_box.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

// The box with these words as its lower and upper corner.
__device__ inline core::Box box_of(const uint4& low, const uint4& high) {
  return {{__uint_as_float(low.x), __uint_as_float(low.y), __uint_as_float(low.z)},
          {__uint_as_float(high.x), __uint_as_float(high.y), __uint_as_float(high.z)}};
}

// One load of 16 bytes, or two for a box. By itself the compiler would load word by word, and a search is limited by
// look-ups of cache lines.
__device__ inline PackedVec3 fetched(const PackedVec3* from) {
  const uint4 word = *reinterpret_cast<const uint4*>(from);
  return {{__uint_as_float(word.x), __uint_as_float(word.y), __uint_as_float(word.z)}, __uint_as_float(word.w)};
}
__device__ inline core::Box fetched(const PackedBox* from) {
  const auto* words = reinterpret_cast<const uint4*>(from);
  return box_of(words[0], words[1]);
}

// A node of a vertex tree, and its word.
struct FetchedNode {
  core::Box box;
  std::uint32_t word = 0;
};
__device__ inline FetchedNode fetched_node(const PackedBox* from) {
  const auto* words = reinterpret_cast<const uint4*>(from);
  const uint4 low = words[0];
  return {box_of(low, words[1]), low.w};
}

__device__ inline MeasuredPair fetched(const MeasuredPair* from) {
  const uint4 word = *reinterpret_cast<const uint4*>(from);
  return {{__uint_as_float(word.x), word.y, word.z}, word.w};
}

__device__ inline PlacedShape fetched(const PlacedShape* from) {
  const uint4 word = *reinterpret_cast<const uint4*>(from);
  return {{__uint_as_float(word.x), __uint_as_float(word.y), __uint_as_float(word.z)}, word.w};
}
__device__ inline PlacedPair fetched(const PlacedPair* from) {
  return {fetched(&from->i), fetched(&from->j)};
}

__device__ inline LeftoverSearch fetched(const LeftoverSearch* from) {
  const uint4 last = reinterpret_cast<const uint4*>(from)[2];
  return {fetched(&from->bodies), last.x, __uint_as_float(last.y), last.z, last.w};
}

}  // namespace broadside::gpu
