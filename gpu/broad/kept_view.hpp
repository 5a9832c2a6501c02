// The launches of a broad phase that keeps pairs between frames: see kept_finder.hpp.
#pragma once

#include <cstdint>

#include "core/pair.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/broad/bulk_view.hpp"
#include "gpu/broad/pack_view.hpp"
#include "gpu/runtime/device_runtime.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

struct KeptCounts {
  unsigned long long pairs = 0;
  std::uint32_t left = 0;  // whether a box is no longer within its fat box
};

// A box's place is that of its entry in the last search, where neighbors in space lie side by side.
struct KeptView {
  std::uint32_t count = 0;
  const PackedBox* now = nullptr;     // [count] this frame's boxes; low_tag = the box's number
  const float* given = nullptr;       // [count][6] where launch_within finds them; null: in `now`
  PackedBox* fat = nullptr;           // [count] by number
  BoxMeasure* measure = nullptr;      // of the fat boxes
  const BulkEntry* order = nullptr;   // [count] by place
  PackedBox* placed = nullptr;        // [count] this frame's, by place
  std::uint32_t* place_of = nullptr;  // [count] by number
  core::Pair* candidates = nullptr;
  std::uint64_t candidate_count = 0;
  AppendView<core::Pair> pairs;
  KeptCounts* counts = nullptr;
};

// All launches are asynchronous. Makes the fat boxes from this frame's; `measure` must be BoxMeasure{} before.
core::Status launch_fatten(const KeptView& view, StreamHandle stream);
// After a search of the fat boxes: notes which box lies at which place.
core::Status launch_place(const KeptView& view, StreamHandle stream);
// After launch_place(): turns the search's pairs into pairs of places.
core::Status launch_renumber(const KeptView& view, StreamHandle stream);
// Puts this frame's boxes at their places, and notes whether one left its fat box. Counts must be zero before, as for
// launch_test().
core::Status launch_within(const KeptView& view, StreamHandle stream);
// Finds the candidates whose boxes overlap in this frame.
core::Status launch_test(const KeptView& view, StreamHandle stream);

}  // namespace broadside::gpu
