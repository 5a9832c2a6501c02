#include "reference/scene_octree/key_sort.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace broadside::reference {
namespace {

// 2048 counters of 4 bytes and as many open destinations: the most that a core's L1 and TLB bear.
constexpr int kMostDigitBits = 11;
// Under this, comparison sorting wins over clearing and summing the counters.
constexpr std::size_t kSmall = 512;
// Under this, starting workers costs more than they save.
constexpr std::size_t kChunk = std::size_t{1} << 14U;

struct Digit {
  unsigned shift;
  std::uint32_t mask;
  [[nodiscard]] std::uint32_t of(KeyedId entry) const { return static_cast<std::uint32_t>(entry >> shift) & mask; }
};

int pass_count(int key_bits) {
  return (key_bits + kMostDigitBits - 1) / kMostDigitBits;
}

// Digits as equal as they come: 24 bits are 8 + 8 + 8.
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

void sort_alone(std::span<KeyedId> entries, std::span<KeyedId> scratch, int key_bits) {
  if (entries.size() <= kSmall) {
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

void KeySort::sort(std::span<KeyedId> entries, std::span<KeyedId> scratch, int key_bits) {
  const std::size_t n = entries.size();
  const auto workers = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  if (n < 2U * kChunk || workers == 1) {
    sort_alone(entries, scratch, key_bits);
    return;
  }
  // A few chunks per worker, so that one that is held up does not hold up all.
  const std::size_t chunk = std::max(kChunk, (n + 4U * workers - 1U) / (4U * workers));
  const std::size_t chunks = (n + chunk - 1U) / chunk;
  const auto part = [&](std::span<KeyedId> all, std::size_t c) {
    return all.subspan(c * chunk, std::min(chunk, n - c * chunk));
  };
  std::span<KeyedId> from = entries;
  std::span<KeyedId> to = scratch.first(n);
  for (int pass = 0; pass < pass_count(key_bits); ++pass) {
    const Digit d = digit(key_bits, pass);
    const std::size_t slots = d.mask + std::size_t{1};
    counts_.resize(chunks * slots);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
      std::uint32_t* count = counts_.data() + c * slots;
      std::fill_n(count, slots, 0U);
      for (const KeyedId entry : part(from, c)) ++count[d.of(entry)];
    });
    std::uint32_t begin = 0;
    for (std::size_t slot = 0; slot < slots; ++slot) {
      for (std::size_t c = 0; c < chunks; ++c) {
        const std::uint32_t count = counts_[c * slots + slot];
        counts_[c * slots + slot] = begin;
        begin += count;
      }
    }
    tbb::parallel_for(std::size_t{0}, chunks,
                      [&](std::size_t c) { scatter(part(from, c), to.data(), d, counts_.data() + c * slots); });
    std::swap(from, to);
  }
  if (from.data() != entries.data()) std::copy(from.begin(), from.end(), entries.begin());
}

}  // namespace broadside::reference
