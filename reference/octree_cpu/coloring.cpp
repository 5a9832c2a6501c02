#include "reference/octree_cpu/coloring.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/method/coloring.hpp"

namespace broadside::reference {

// Doubles the colors that each body has room for; happens when some body is in more than 64 contacts, say.
void Coloring::widen(std::size_t bodies) {
  std::vector<std::uint64_t> wider(bodies * words_ * 2);
  for (std::size_t b = 0; b < bodies; ++b)
    std::copy_n(taken_.begin() + static_cast<std::ptrdiff_t>(b * words_), words_,
                wider.begin() + static_cast<std::ptrdiff_t>(b * words_ * 2));
  taken_ = std::move(wider);
  words_ *= 2;
}

std::uint32_t Coloring::smallest_free(core::Pair p, std::span<const std::uint8_t> never_written) {
  for (std::size_t word = 0;; ++word) {
    if (word == words_) widen(never_written.size());
    std::uint64_t taken = 0;
    if (never_written[p.i] == 0) taken |= taken_[p.i * words_ + word];
    if (never_written[p.j] == 0) taken |= taken_[p.j * words_ + word];
    if (taken == ~std::uint64_t{0}) continue;
    const int free = std::countr_one(taken);
    if (never_written[p.i] == 0) taken_[p.i * words_ + word] |= std::uint64_t{1} << free;
    if (never_written[p.j] == 0) taken_[p.j * words_ + word] |= std::uint64_t{1} << free;
    return static_cast<std::uint32_t>(word * 64) + static_cast<std::uint32_t>(free);
  }
}

void Coloring::color(std::span<const core::Pair> pairs, std::span<const std::uint8_t> never_written) {
  words_ = 1;
  taken_.assign(never_written.size(), 0);
  by_priority_.resize(pairs.size());
  std::iota(by_priority_.begin(), by_priority_.end(), 0U);
  std::sort(by_priority_.begin(), by_priority_.end(), [&](std::uint32_t p, std::uint32_t q) {
    return core::color_priority(pairs[p]) < core::color_priority(pairs[q]);
  });

  color_.resize(pairs.size());
  std::uint32_t colors = 0;
  for (const std::uint32_t k : by_priority_) {
    color_[k] = smallest_free(pairs[k], never_written);
    colors = std::max(colors, color_[k] + 1);
  }

  begin_.assign(colors + 1, 0);
  for (const std::uint32_t c : color_) ++begin_[c + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(pairs.size());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end());
  for (std::uint32_t k = 0; k < pairs.size(); ++k) order_[next[color_[k]]++] = k;
}

}  // namespace broadside::reference
