// The patches of a step in tiles: color by color, and within a color by their number of points. So the lanes of a tile
// share no moved body and have equally many points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "reference/octree_cpu/rigid/patch_coloring.hpp"
#include "reference/octree_cpu/rigid/patch_kernels.hpp"

namespace broadside::reference {

class PatchTiles {
 public:
  static constexpr std::uint32_t kNoPatch = 0xFFFFFFFFU;

  explicit PatchTiles(const PatchKernels& kernels) : kernels_(&kernels) {}

  // Makes room for these patches. Lanes without a patch name the body `still`, which never moves.
  void arrange(std::span<const core::ContactPatch> patches, const PatchColoring& coloring, std::uint32_t still);

  [[nodiscard]] const PatchKernels& kernels() const { return *kernels_; }
  [[nodiscard]] std::size_t count() const { return color_begin_.back(); }
  [[nodiscard]] std::size_t places() const { return count() * kTileLanes; }
  // Tiles of color c are [color_begin()[c], color_begin()[c + 1]).
  [[nodiscard]] std::span<const std::uint32_t> color_begin() const { return color_begin_; }
  // By place, which is a lane of a tile: the index of its patch as given, or kNoPatch.
  [[nodiscard]] std::span<const std::uint32_t> patch_at() const { return patch_at_; }

  void clear_tile(std::size_t tile) { kernels_->clear(memory(), tile, still_); }
  void put(std::size_t place, const core::PatchConstraint& c) {
    kernels_->put(memory(), place / kTileLanes, static_cast<std::uint32_t>(place % kTileLanes), c);
  }
  [[nodiscard]] core::PatchConstraint get(std::size_t place) const {
    return kernels_->get(memory(), place / kTileLanes, static_cast<std::uint32_t>(place % kTileLanes));
  }
  [[nodiscard]] TileRange range(std::size_t first, std::size_t last, core::SolverBody* bodies) {
    return {memory(), first, last, bodies};
  }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(std::byte* memory) const { ::operator delete(memory, kAlignment); }
  };
  [[nodiscard]] std::byte* memory() const { return memory_.get(); }

  const PatchKernels* kernels_;
  std::unique_ptr<std::byte[], Free> memory_;
  std::size_t room_ = 0;  // of how many tiles
  std::uint32_t still_ = 0;
  std::vector<std::uint32_t> color_begin_{0};
  std::vector<std::uint32_t> patch_at_;
};

}  // namespace broadside::reference
