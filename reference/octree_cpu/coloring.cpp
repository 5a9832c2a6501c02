#include "reference/octree_cpu/coloring.hpp"

#include <algorithm>
#include <numeric>

#include "core/method/coloring.hpp"

namespace broadside::reference {

void Coloring::color(std::span<const core::Pair> pairs, std::span<const std::uint8_t> never_written) {
  by_priority_.resize(pairs.size());
  std::iota(by_priority_.begin(), by_priority_.end(), 0U);
  std::sort(by_priority_.begin(), by_priority_.end(), [&](std::uint32_t p, std::uint32_t q) {
    return core::color_priority(pairs[p]) < core::color_priority(pairs[q]);
  });

  next_.assign(never_written.size(), 0);
  color_.resize(pairs.size());
  std::uint32_t colors = 0;
  for (const std::uint32_t k : by_priority_) {
    const auto [i, j] = pairs[k];
    std::uint32_t color = 0;
    if (never_written[i] == 0) color = next_[i];
    if (never_written[j] == 0) color = std::max(color, next_[j]);
    next_[i] = next_[j] = color + 1;
    color_[k] = color;
    colors = std::max(colors, color + 1);
  }

  begin_.assign(colors + 1, 0);
  for (const std::uint32_t c : color_) ++begin_[c + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(pairs.size());
  std::vector<std::uint32_t> place(begin_.begin(), begin_.end());
  for (std::uint32_t k = 0; k < pairs.size(); ++k) order_[place[color_[k]]++] = k;
}

}  // namespace broadside::reference
