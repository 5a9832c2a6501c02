// What may be chosen about a broad phase on the GPU that runs alone.
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

  // Where the pairs of these boxes come from.
  [[nodiscard]] Start start(const BoxFacts& facts) const {
    if (variant == core::Variant::kE2 || variant == core::Variant::kE7) return Start::kOctree;
    if (broad == Broad::kOctree) return Start::kOctree;
    if (broad == Broad::kHash) return Start::kHash;
    if (broad != Broad::kTree || facts.count < least_for_grid || !fits_grid(facts)) return Start::kTiles;
    return facts.count < least_for_bulk ? Start::kGrid : Start::kBulk;
  }
  [[nodiscard]] bool may_have_passes() const {
    return broad == Broad::kTree && variant != core::Variant::kE2 && variant != core::Variant::kE7;
  }
};

}  // namespace broadside::gpu
