// A search of bulk pairs over a share of the boxes, whose pairs have the caller's numbers: of a part of space, with
// guests of other parts, or of a set whose pairs do not fit at once.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// By the search's numbers of boxes.
struct PairNames {
  std::uint32_t base = 0;                   // of the caller's numbers
  std::uint32_t first_told = 0xFFFFFFFFU;   // from here on, the caller's number of a box is its low_tag
  std::uint32_t first_guest = 0xFFFFFFFFU;  // from here on, boxes make no pairs with each other
};

struct NamedPairsView {
  PairsView search;  // starts as Start::kBulk
  PairNames names;
  // Places among the entries whose boxes look for their partners.
  std::uint64_t first_place = 0;
  std::uint64_t end_place = 0;
  bool is_in_order = false;  // the entries are those of the launch before
};

// Of pairs_launch_shape's, with the search's own blocks.
core::Result<PairsShape> named_pairs_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits);
// Asynchronous.
core::Status launch_named_pairs(const NamedPairsView& view, const PairsShape& shape, StreamHandle stream);
// The launch before a search, where the shape has bins.
core::Status launch_sort(const PairsView& view, const PairsShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
