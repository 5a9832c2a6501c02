// A search of bulk pairs for a share of the boxes, which names boxes by the caller's numbers. The share is a part of
// space, with guests from other parts, or a part of a set whose pairs do not fit at once.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_runtime.hpp"

namespace broadside::gpu {

// How the search's own numbers of boxes become the caller's.
struct PairNames {
  std::uint32_t base = 0;                   // the caller's number of the search's box 0
  std::uint32_t first_told = 0xFFFFFFFFU;   // from here on, the caller's number of a box is its low_tag
  std::uint32_t first_guest = 0xFFFFFFFFU;  // from here on, boxes make no pairs with each other
};

struct NamedPairsView {
  PairsView search;  // starts as Start::kBulk
  PairNames names;
  // The boxes whose entries are at these places look for their partners.
  std::uint64_t first_place = 0;
  std::uint64_t end_place = 0;
  bool is_in_order = false;  // the entries of the launch before are still valid
};

// As pairs_launch_shape(), but with as many blocks as this search can have.
core::Result<PairsShape> named_pairs_launch_shape(std::uint32_t boxes, std::uint32_t buckets, const BinLimits& limits);
// Asynchronous.
core::Status launch_named_pairs(const NamedPairsView& view, const PairsShape& shape, StreamHandle stream);
// The launch that must come before a search if the shape has bins.
core::Status launch_sort(const PairsView& view, const PairsShape& shape, StreamHandle stream);

}  // namespace broadside::gpu
