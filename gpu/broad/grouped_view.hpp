// A search for pairs by groups of neighboring boxes: its launch, and the view that the kernel gets by value.
// grouped_kernel.cu and on_host/grouped_on_host.cpp implement it.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// How many boxes a group has, one for each lane, and how many groups a cluster.
constexpr std::uint32_t kGroupSize = 32;

// Boxes go to cells of a cube around all of them, 2^axis_bits on each axis, along a Morton curve. Cells are counted in
// chunks of kBucketChunk; each chunk's entries fill whole groups, the last of which has empty boxes behind its own.
struct GroupView {
  core::Vec3 corner;  // lower corner of the cube
  float cells_per_m = 0.0F;
  std::uint32_t axis_bits = 0;
  std::uint32_t* count = nullptr;        // [cells] boxes; zero between searches
  std::uint32_t* begin = nullptr;        // [cells] where a cell's entries are
  std::uint32_t* rank = nullptr;         // [boxes] place within the cell
  std::uint32_t* chunk_room = nullptr;   // [chunks] entries, a multiple of kGroupSize
  std::uint32_t* entry_count = nullptr;  // [1] entries of all chunks
  PackedBox* entries = nullptr;   // [as many as grouped_entries] low_tag = box, high_tag: 1 = static; or an empty box
  PackedBox* groups = nullptr;    // around kGroupSize entries each: low_tag = group, high_tag: 1 = all static
  PackedBox* clusters = nullptr;  // around kGroupSize groups each, likewise
  AppendView<core::Pair> group_pairs;  // pairs of groups that overlap, and each group with itself

  [[nodiscard]] BROADSIDE_HD std::uint32_t cells() const { return 1U << 3 * axis_bits; }
  [[nodiscard]] BROADSIDE_HD std::uint32_t chunks() const { return cells() / kBucketChunk; }
};

struct GroupedPairsView {
  PairsView search;
  GroupView grouping;
};

core::Result<LaunchShape> grouped_pairs_launch_shape();
// Asynchronous.
core::Status launch_grouped_pairs(const GroupedPairsView& view, const LaunchShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
