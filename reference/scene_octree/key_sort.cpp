#include "reference/scene_octree/key_sort.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace broadside::reference {
namespace {

// 2048 counters of 4 bytes and as many open destinations: the most that fit a core's L1 and TLB.
constexpr int kMostDigitBits = 11;
// For fewer entries, a comparison sort is faster than clearing and summing the counters.
constexpr std::size_t kFewEntries = 512;

struct Digit {
  unsigned shift;
  std::uint32_t mask;
  [[nodiscard]] std::uint32_t of(KeyedId entry) const { return static_cast<std::uint32_t>(entry >> shift) & mask; }
};

int pass_count(int key_bits) {
  return (key_bits + kMostDigitBits - 1) / kMostDigitBits;
}

// Digits have nearly equal widths: 24 bits are 8 + 8 + 8.
Digit digit(int key_bits, int pass) {
  const int passes = pass_count(key_bits);
  const int first = key_bits * pass / passes;
  const int last = key_bits * (pass + 1) / passes;
  return {static_cast<unsigned>(32 + first), (1U << static_cast<unsigned>(last - first)) - 1U};
}

void scatter(std::span<const KeyedId> from, KeyedId* to, Digit d, std::uint32_t* next) {
  for (const KeyedId entry : from) to[next[d.of(entry)]++] = entry;
}

}  // namespace

void sort_by_key(std::span<KeyedId> entries, std::span<KeyedId> scratch, int key_bits) {
  if (entries.size() <= kFewEntries) {
    // Keys have no bits above key_bits, and ids of equal keys are already in order.
    std::sort(entries.begin(), entries.end());
    return;
  }
  std::span<KeyedId> from = entries;
  std::span<KeyedId> to = scratch.first(entries.size());
  std::array<std::uint32_t, 1U << kMostDigitBits> next;
  for (int pass = 0; pass < pass_count(key_bits); ++pass) {
    const Digit d = digit(key_bits, pass);
    next.fill(0);
    for (const KeyedId entry : from) ++next[d.of(entry)];
    std::uint32_t begin = 0;
    for (std::uint32_t& slot : next) {
      const std::uint32_t count = slot;
      slot = begin;
      begin += count;
    }
    scatter(from, to.data(), d, next.data());
    std::swap(from, to);
  }
  if (from.data() != entries.data()) std::copy(from.begin(), from.end(), entries.begin());
}

}  // namespace broadside::reference
