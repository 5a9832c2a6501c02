#include "reference/octree_cpu/rigid/impulse_memory.hpp"

#include <algorithm>

#include "core/pair.hpp"

namespace broadside::reference {

static_assert(core::kManifoldPoints == 4, "the memory has four points a patch");

std::span<const RememberedPoint> ImpulseMemory::of(std::uint32_t a, std::uint32_t b) const {
  const auto [first, last] = std::equal_range(pairs_.begin(), pairs_.end(), core::pair_key({a, b}));
  return std::span(points_).subspan(4 * static_cast<std::size_t>(first - pairs_.begin()),
                                    4 * static_cast<std::size_t>(last - first));
}

std::uint32_t ImpulseMemory::index_of(std::uint32_t a, std::uint32_t b) const {
  return static_cast<std::uint32_t>(std::lower_bound(pairs_.begin(), pairs_.end(), core::pair_key({a, b})) -
                                    pairs_.begin());
}

void ImpulseMemory::forget() {
  pairs_.clear();
  points_.clear();
}

void ImpulseMemory::begin(std::span<const core::ContactPatch> patches) {
  pairs_.resize(patches.size());
  for (std::size_t k = 0; k < patches.size(); ++k) pairs_[k] = core::pair_key({patches[k].a, patches[k].b});
  points_.assign(4 * patches.size(), {});
}

}  // namespace broadside::reference
