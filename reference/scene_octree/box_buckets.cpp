#include "reference/scene_octree/box_buckets.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>

#include "reference/scene_octree/box_check.hpp"
#include "reference/scene_octree/curve_keys.hpp"

namespace broadside::reference {
namespace {

using core::Box;

// A bucket's records and its keys fit a core's L2 several times over: 2048 x 32 bytes.
constexpr std::uint32_t kBucketBoxes = 2048;
// Larger ones are split again.
constexpr std::uint32_t kLargeBucket = 4 * kBucketBoxes;
// From this size on all workers share one split.
constexpr std::uint32_t kHugeBucket = 32 * kBucketBoxes;
// Under this many boxes a chunk, starting workers costs more than they save.
constexpr std::size_t kChunk = std::size_t{1} << 13U;
// 4096 open destinations, of a line each, fit L2 and its TLB.
constexpr int kMostSplitBits = 4;

int split_bits(std::uint32_t n) {
  if (n <= kLargeBucket / 2U) return 0;
  return std::min(kMostSplitBits, (static_cast<int>(std::bit_width(n / kBucketBoxes)) + 2) / 3);
}

Box united(const Box& a, const Box& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

// Cuts a number of boxes into pieces of equal size for workers.
struct Chunks {
  std::size_t count;
  std::size_t size;

  Chunks(std::size_t n, bool alone) : count(1), size(n) {
    // A few for each worker, so that a delayed worker does not delay all.
    const auto wanted = 4U * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    if (alone || n < 2U * kChunk) return;
    size = std::max(kChunk, (n + wanted - 1U) / wanted);
    count = (n + size - 1U) / size;
  }

  // work(chunk, begin, end)
  template <typename Work>
  void run(std::size_t n, const Work& work) const {
    if (count == 1) {
      work(std::size_t{0}, std::size_t{0}, n);
      return;
    }
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t c) { work(c, c * size, std::min(n, (c + 1U) * size)); });
  }
};

// Copies n boxes to the places of their slots; number(begin, end, count) writes slot_of[k] for each chunk. Afterwards
// counts[slot] is the end of each slot. Stable.
template <typename Number, typename RecordAt>
void scatter(std::size_t n, bool alone, std::size_t slots, std::vector<std::uint32_t>& counts, const Number& number,
             const std::uint32_t* slot_of, const RecordAt& record_at, BoxRecord* to) {
  const Chunks chunks(n, alone);
  counts.assign(chunks.count * slots, 0);
  chunks.run(n,
             [&](std::size_t c, std::size_t begin, std::size_t end) { number(begin, end, counts.data() + c * slots); });
  std::uint32_t place = 0;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    for (std::size_t c = 0; c < chunks.count; ++c) {
      const std::uint32_t count = counts[c * slots + slot];
      counts[c * slots + slot] = place;
      place += count;
    }
  }
  chunks.run(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
    std::uint32_t* next = counts.data() + c * slots;
    for (std::size_t k = begin; k < end; ++k) to[next[slot_of[k]]++] = record_at(k);
  });
  // The last chunk's places have moved to the slots' ends.
  if (chunks.count > 1) std::copy_n(counts.data() + (chunks.count - 1U) * slots, slots, counts.data());
}

}  // namespace

bool BoxBuckets::deal(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  buckets_.clear();
  plan_.counts.clear();
  if (boxes.empty()) return true;
  if (!survey(boxes)) return false;
  deal_all(boxes, is_static);
  split_large();
  join_small();
  return true;
}

bool BoxBuckets::survey(std::span<const Box> boxes) {
  const std::size_t n = boxes.size();
  const Chunks chunks(n, false);
  surveys_.resize(chunks.count);
  chunks.run(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
    // Neighbors often share a bin; with four tables their increments need not wait for one another.
    std::array<std::array<std::uint32_t, core::kSizeBins>, 4> sizes{};
    Box bounds = core::empty_box();
    bool is_sound = true;
    for (std::size_t i = begin; i < end; ++i) {
      const Box& box = boxes[i];
      is_sound &= (box.min.x <= box.max.x) & (box.min.y <= box.max.y) & (box.min.z <= box.max.z);
      bounds = united(bounds, box);
      // The mask keeps the index in range for a box that is not sound, whose side may have a sign.
      ++sizes[i % 4U][static_cast<std::size_t>(core::size_bin(box)) & 255U];
    }
    Survey& survey = surveys_[c];
    // An infinite bound of any box shows in the bounds of all boxes.
    survey.is_sound = is_sound && is_sound_box(bounds);
    survey.bounds = bounds;
    for (std::size_t bin = 0; bin < survey.sizes.size(); ++bin)
      survey.sizes[bin] = sizes[0][bin] + sizes[1][bin] + sizes[2][bin] + sizes[3][bin];
  });
  whole_ = surveys_[0];
  for (std::size_t c = 1; c < surveys_.size(); ++c) {
    const Survey& part = surveys_[c];
    whole_.is_sound &= part.is_sound;
    whole_.bounds = united(whole_.bounds, part.bounds);
    for (std::size_t bin = 0; bin < whole_.sizes.size(); ++bin) whole_.sizes[bin] += part.sizes[bin];
  }
  return whole_.is_sound;
}

void BoxBuckets::deal_all(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  const std::size_t n = boxes.size();
  double bounds_m3 = 1.0;
  for (int axis = 0; axis < 3; ++axis)
    bounds_m3 *= static_cast<double>(whole_.bounds.max[axis]) - static_cast<double>(whole_.bounds.min[axis]);
  plan_ = plan_size_classes(whole_.sizes, bounds_m3);

  // The bounds of all boxes are used as the bounds of their centers. Where cells become too coarse by that, buckets are
  // split again.
  const Box half_bounds{0.5F * whole_.bounds.min, 0.5F * whole_.bounds.max};
  const int bits = split_bits(static_cast<std::uint32_t>(n));
  const core::CurveGrid grid = core::make_curve_grid(half_bounds, bits);
  const std::uint32_t cells = 1U << static_cast<unsigned>(3 * bits);
  std::array<std::uint32_t, core::kSizeBins> first_slot;
  for (std::size_t bin = 0; bin < first_slot.size(); ++bin) first_slot[bin] = plan_.class_of_bin[bin] * cells;

  bucket_of_.resize(n);
  for (auto& copy : records_) copy.resize(n);
  scatter(
      n, false, class_count() * cells, counts_,
      [&](std::size_t begin, std::size_t end, std::uint32_t* count) {
        for_each_code(
            grid, begin, end, [&](std::size_t i) -> const Box& { return boxes[i]; },
            [&](std::size_t i, std::uint32_t code) {
              const std::uint32_t slot = first_slot[static_cast<std::size_t>(core::size_bin(boxes[i]))] + code;
              bucket_of_[i] = slot;
              ++count[slot];
            });
      },
      bucket_of_.data(),
      [&](std::size_t i) {
        return BoxRecord{boxes[i], static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(is_static[i] != 0)};
      },
      records_[0].data());
  std::uint32_t begin = 0;
  for (std::uint32_t slot = 0; slot < class_count() * cells; ++slot) {
    if (counts_[slot] > begin)
      buckets_.push_back({begin, counts_[slot], static_cast<std::uint16_t>(slot / cells), 0, false});
    begin = counts_[slot];
  }
}

void BoxBuckets::split(const Bucket& bucket, bool alone, std::vector<Bucket>& parts) {
  const std::uint32_t n = bucket.count();
  const BoxRecord* from = records(bucket);
  const Chunks chunks(n, alone);
  std::vector<Box> bounds(chunks.count, core::empty_box());
  chunks.run(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Box part = core::empty_box();
    for (std::size_t k = begin; k < end; ++k) part = core::grown(part, core::half_center(from[k].box));
    bounds[c] = part;
  });
  Box half_centers = bounds[0];
  for (const Box& part : bounds) half_centers = united(half_centers, part);
  const core::CurveGrid grid = core::make_curve_grid(half_centers, std::max(1, split_bits(n)));
  if (grid.cells_per_m == 0.0F) {
    Bucket whole = bucket;
    whole.is_one_point = true;
    parts.push_back(whole);
    return;
  }
  const std::uint32_t cells = 1U << static_cast<unsigned>(3 * grid.bits);
  std::vector<std::uint32_t> own_counts;
  std::vector<std::uint32_t>& counts = alone ? own_counts : counts_;
  std::uint32_t* slot_of = bucket_of_.data() + bucket.begin;
  const auto other = static_cast<std::uint8_t>(1U - bucket.buffer);
  scatter(
      n, alone, cells, counts,
      [&](std::size_t begin, std::size_t end, std::uint32_t* count) {
        for_each_code(
            grid, begin, end, [&](std::size_t k) -> const Box& { return from[k].box; },
            [&](std::size_t k, std::uint32_t code) {
              slot_of[k] = code;
              ++count[code];
            });
      },
      slot_of, [&](std::size_t k) { return from[k]; }, records_[other].data() + bucket.begin);
  std::uint32_t begin = 0;
  for (std::uint32_t slot = 0; slot < cells; ++slot) {
    if (counts[slot] > begin)
      parts.push_back({bucket.begin + begin, bucket.begin + counts[slot], bucket.size_class, other, false});
    begin = counts[slot];
  }
}

void BoxBuckets::split_until_small(const Bucket& bucket, std::vector<Bucket>& parts) {
  if (bucket.count() <= kLargeBucket || bucket.is_one_point) {
    parts.push_back(bucket);
    return;
  }
  std::vector<Bucket> own_parts;
  split(bucket, true, own_parts);
  for (const Bucket& part : own_parts) split_until_small(part, parts);
}

void BoxBuckets::split_large() {
  const auto is_over = [](std::uint32_t most) {
    return [most](const Bucket& b) { return b.count() > most && !b.is_one_point; };
  };
  // Huge buckets are split one after another, each by all workers. Centers at opposite ends of a grid fall into
  // different cells, so each round splits.
  while (std::any_of(buckets_.begin(), buckets_.end(), is_over(kHugeBucket))) {
    next_buckets_.clear();
    for (const Bucket& bucket : buckets_) {
      if (is_over(kHugeBucket)(bucket))
        split(bucket, false, next_buckets_);
      else
        next_buckets_.push_back(bucket);
    }
    buckets_.swap(next_buckets_);
  }
  if (std::none_of(buckets_.begin(), buckets_.end(), is_over(kLargeBucket))) return;
  // Each of the other buckets is split by one worker.
  std::vector<std::vector<Bucket>> parts(buckets_.size());
  tbb::parallel_for(std::size_t{0}, buckets_.size(), [&](std::size_t b) { split_until_small(buckets_[b], parts[b]); });
  buckets_.clear();
  for (const auto& own_parts : parts) buckets_.insert(buckets_.end(), own_parts.begin(), own_parts.end());
}

// Neighbors are joined to one bucket while they fit into it, because each bucket's last pack may have free lanes.
void BoxBuckets::join_small() {
  std::size_t last = 0;
  for (std::size_t b = 1; b < buckets_.size(); ++b) {
    Bucket& into = buckets_[last];
    const Bucket& next = buckets_[b];
    if (into.size_class == next.size_class && into.buffer == next.buffer && into.count() + next.count() <= kBucketBoxes)
      into.end = next.end;
    else
      buckets_[++last] = next;
  }
  if (!buckets_.empty()) buckets_.resize(last + 1U);
}

}  // namespace broadside::reference
