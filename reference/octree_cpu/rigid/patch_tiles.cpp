#include "reference/octree_cpu/rigid/patch_tiles.hpp"

#include <algorithm>
#include <new>

namespace broadside::reference {

void PatchTiles::arrange(std::span<const core::ContactPatch> patches, const PatchColoring& coloring,
                         std::uint32_t still) {
  still_ = still;
  patch_at_.clear();
  color_begin_.assign(1, 0);
  const auto order = coloring.order();
  for (std::uint32_t color = 0; color < coloring.color_count(); ++color) {
    const auto of_color =
        order.subspan(coloring.color_begin()[color], coloring.color_begin()[color + 1] - coloring.color_begin()[color]);
    for (int points = core::kManifoldPoints; points > 0; --points) {
      for (const std::uint32_t patch : of_color)
        if (patches[patch].manifold.count == points) patch_at_.push_back(patch);
      while (patch_at_.size() % kTileLanes != 0) patch_at_.push_back(kNoPatch);
    }
    color_begin_.push_back(static_cast<std::uint32_t>(patch_at_.size() / kTileLanes));
  }
  if (count() <= room_) return;
  room_ = std::max(count(), 2 * room_);
  memory_.reset(static_cast<std::byte*>(::operator new(room_ * kernels_->tile_bytes, kAlignment)));
}

}  // namespace broadside::reference
