// Options of a broad phase on the GPU that runs alone.
#pragma once

#include <cstdint>

#include "core/method/box_passes.hpp"
#include "core/variant.hpp"
#include "gpu/broad/broad_buffers.hpp"

namespace broadside::gpu {

struct PairFinderOptions {
  Broad broad = Broad::kTree;  // the hashed octree; for few boxes, and with kBrute, all pairs in tiles
  core::Variant variant = core::Variant::kSound;
  float hash_cell_m = 0.25F;
  std::uint32_t least_for_grid = kLeastBodiesForGrid;
  std::uint32_t least_for_bulk = kLeastBoxesForBulk;
  std::uint32_t least_for_bins = kLeastBoxesForBins;
  std::uint32_t least_for_passes = core::kLeastBoxesForPasses;
  std::uint32_t least_for_apart = kLeastBoxesForBulk;  // to keep static boxes in a table of their own
  std::uint64_t pairs_at_once = 0;                     // how many pairs the device has room for; 0: all
  float cell_scale = 0.0F;                             // of BulkFit; 0: what fits the boxes that are loaded
  std::uint32_t lanes_per_box = 0;                     // likewise
  std::uint32_t levels_apart = 0;                      // likewise
  std::uint32_t x_halvings = kFitted;                  // likewise
  std::uint32_t groups = kFitted;                      // likewise: 1 where boxes are searched by groups
  static constexpr std::uint32_t kFitted = 0xFFFFFFFFU;
  bool has_shares = false;  // boxes are searched share by share or part by part, so by the search of bulk pairs alone
  std::uint32_t most_bins_at_once = 0;  // of BinLimits

  // Which start finds the pairs of these boxes.
  [[nodiscard]] Start start(const BoxFacts& facts) const {
    if (variant == core::Variant::kE2 || variant == core::Variant::kE7) return Start::kOctree;
    if (broad == Broad::kOctree) return Start::kOctree;
    if (broad == Broad::kHash) return Start::kHash;
    if (broad != Broad::kTree || (facts.count < least_for_grid && !has_shares) || !fits_grid(facts))
      return Start::kTiles;
    return facts.count < least_for_bulk && !has_shares ? Start::kGrid : Start::kBulk;
  }
  [[nodiscard]] bool may_have_passes() const {
    return broad == Broad::kTree && variant != core::Variant::kE2 && variant != core::Variant::kE7;
  }
};

}  // namespace broadside::gpu
