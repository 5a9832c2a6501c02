#include "reference/scene_octree/pair_order.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace broadside::reference {
namespace {

// Below this, one std::sort on one core is faster than starting the workers.
constexpr std::size_t kFewPairs = 2048;
// Buckets aim at 16 Ki pairs, 128 KiB: half of a common 256 KiB L2, since source and destination are both live.
constexpr std::size_t kPairsPerBucket = std::size_t{1} << 14U;
// With more destinations, the dealing pass would miss the TLB on every write.
constexpr std::size_t kMostBuckets = 1024;
// Rows of up to this length are sorted by insertion.
constexpr std::size_t kShortRow = 24;

void sort_row(core::Pair* first, core::Pair* last) {
  if (static_cast<std::size_t>(last - first) > kShortRow) {
    std::sort(first, last, [](core::Pair a, core::Pair b) { return a.j < b.j; });
    return;
  }
  for (core::Pair* next = first + 1; next < last; ++next) {
    const core::Pair moved = *next;
    core::Pair* hole = next;
    for (; hole > first && moved.j < hole[-1].j; --hole) *hole = hole[-1];
    *hole = moved;
  }
}

// Places one bucket's pairs, whose i lie in [first_i, first_i + ids), at `to` in canonical order.
void place_bucket(std::span<const core::Pair> from, std::uint32_t first_i, std::uint32_t ids, core::Pair* to,
                  std::vector<std::uint32_t>& row_end) {
  row_end.assign(ids + 1U, 0);
  for (const core::Pair p : from) ++row_end[p.i - first_i + 1U];
  std::partial_sum(row_end.begin(), row_end.end(), row_end.begin());
  for (const core::Pair p : from) to[row_end[p.i - first_i]++] = p;
  std::uint32_t begin = 0;
  for (std::uint32_t row = 0; row < ids; ++row) {
    const std::uint32_t end = row_end[row];
    if (end - begin > 1U) sort_row(to + begin, to + end);
    begin = end;
  }
}

}  // namespace

void PairOrder::order(std::span<const std::span<const core::Pair>> blocks, std::uint32_t body_count,
                      std::vector<core::Pair>& out) {
  std::size_t total = 0;
  for (const auto block : blocks) total += block.size();
  out.resize(total);
  if (total <= kFewPairs) {
    core::Pair* to = out.data();
    for (const auto block : blocks) to = std::copy(block.begin(), block.end(), to);
    std::sort(out.begin(), out.end(), [](core::Pair a, core::Pair b) { return core::pair_key(a) < core::pair_key(b); });
    return;
  }

  const std::size_t wanted = std::clamp(total / kPairsPerBucket, std::size_t{1}, kMostBuckets);
  const auto id_bits = static_cast<unsigned>(std::bit_width(body_count - 1U));
  const unsigned bucket_bits = std::min(id_bits, static_cast<unsigned>(std::bit_width(wanted)));
  const unsigned shift = id_bits - bucket_bits;
  const std::size_t buckets = std::size_t{1} << bucket_bits;

  counts_.assign(blocks.size() * buckets, 0);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    std::uint64_t* count = counts_.data() + b * buckets;
    for (const core::Pair p : blocks[b]) ++count[p.i >> shift];
  });
  bucket_begin_.resize(buckets + 1U);
  std::uint64_t begin = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    bucket_begin_[bucket] = begin;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const std::uint64_t count = counts_[b * buckets + bucket];
      counts_[b * buckets + bucket] = begin;
      begin += count;
    }
  }
  bucket_begin_[buckets] = begin;

  if (dealt_.size() < total) dealt_.resize(total + total / 8U);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    std::uint64_t* next = counts_.data() + b * buckets;
    for (const core::Pair p : blocks[b]) dealt_[next[p.i >> shift]++] = p;
  });
  tbb::parallel_for(std::size_t{0}, buckets, [&](std::size_t bucket) {
    thread_local std::vector<std::uint32_t> row_end;
    const std::uint64_t from = bucket_begin_[bucket];
    const std::uint64_t count = bucket_begin_[bucket + 1U] - from;
    if (count == 0) return;
    place_bucket({dealt_.data() + from, count}, static_cast<std::uint32_t>(bucket << shift), 1U << shift,
                 out.data() + from, row_end);
  });
}

}  // namespace broadside::reference
