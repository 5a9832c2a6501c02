// What the kernel of small frames gets by value.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/leftover_work.hpp"
#include "gpu/frame/measured_pair.hpp"

namespace broadside::gpu {

struct SmallFrameView : FrameView {
  // True if the levels below 0 are tested where pairs are found, not while their vertices are searched.
  bool are_levels_first = false;
  std::uint32_t ring_share = 1;             // places of the ring that a warp takes
  MeasuredPair* measured = nullptr;         // one per pair whose vertices are searched
  PlacedPair* placed = nullptr;             // where the bodies of such a pair are
  unsigned long long* given_out = nullptr;  // how many pairs warps have taken to search; zero between frames
  LeftoverView leftovers[2];
};

// Whether pairs come to the vertex stage before their levels are tested.
BROADSIDE_HD bool are_levels_left(const SmallFrameView& f) {
  return f.levels != core::Levels::kFlat && !f.are_levels_first;
}

}  // namespace broadside::gpu
