// The launches, apart from the search, for a set that is spread over devices: one finds the boxes that reach into later
// parts, the other adds up the digest of the pairs that were found.
#pragma once

#include <cstdint>

#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// The boxes of one part, and the cut of space into parts (core/engine/space_parts.hpp).
struct BorderView {
  std::uint32_t count = 0;
  const PackedBox* boxes = nullptr;
  int axis = 0;
  const float* faces = nullptr;  // [parts - 1]
  std::uint32_t part = 0;        // the part in which these boxes begin
  std::uint32_t parts = 1;
  std::uint32_t base = 0;    // the number of the first box
  bool keeps_names = false;  // boxes keep their low_tag; else it becomes their number
  // The boxes that reach into part k are written from out[k * capacity] on, with their numbers; reached[k] counts them.
  PackedBox* out = nullptr;
  // If the boxes are in the coordinates of a pass: the same boxes as given, written to the same places of given_out.
  const PackedBox* given = nullptr;
  PackedBox* given_out = nullptr;
  std::uint64_t capacity = 0;             // of each part
  unsigned long long* reached = nullptr;  // [parts], zero before
};
// Asynchronous, like the others.
core::Status launch_borders(const BorderView& view, StreamHandle stream);

struct PairDigestView {
  const core::Pair* pairs = nullptr;
  std::uint64_t count = 0;
  unsigned long long* sum = nullptr;  // zero before; core::pair_digest
};
core::Status launch_pair_digest(const PairDigestView& view, StreamHandle stream);

}  // namespace broadside::gpu
