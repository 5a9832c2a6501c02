// The launches of a set that is spread over devices, beside the search: boxes that reach into later parts, and the
// digest of the pairs that were found.
#pragma once

#include <cstdint>

#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// Boxes of one part, and the cut (core/engine/space_parts.hpp).
struct BorderView {
  std::uint32_t count = 0;
  const PackedBox* boxes = nullptr;
  int axis = 0;
  const float* faces = nullptr;  // [parts - 1]
  std::uint32_t part = 0;        // in which these boxes begin
  std::uint32_t parts = 1;
  std::uint32_t base = 0;    // the number of the first box
  bool keeps_names = false;  // boxes keep their low_tag in the place of their number
  // Those that reach into part k: out[k * capacity] and on, with their numbers; how many there are: reached[k].
  PackedBox* out = nullptr;
  // Of boxes in the coordinates of a pass, also these boxes as given, in the same places.
  const PackedBox* given = nullptr;
  PackedBox* given_out = nullptr;
  std::uint64_t capacity = 0;             // of each k
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
