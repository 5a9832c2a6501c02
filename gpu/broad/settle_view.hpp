// What a search in mapped coordinates needs for the pairs as given: core/method/box_passes.hpp.
#pragma once

#include <cstdint>

#include "core/pair.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

struct SettleView {
  // By the search's number of a box: the box as given. low_tag = the caller's number; high_tag: bit 0 = static, then
  // the group. Null: what the search finds are the pairs.
  const PackedBox* given = nullptr;
  std::uint32_t owned = 0;       // bit g: pairs within group g are kept here
  AppendView<core::Pair> pairs;  // demanded: Counters::confirmed
};

}  // namespace broadside::gpu
