// The first half of building the tree: boxes are copied into buckets, by size class and then along the Hilbert curve,
// so that the second half works on a few thousand neighbors at a time, in a core's own cache. Sorting keys and then
// fetching a million boxes in sorted order costs a memory latency for each box; copying them twice as streams does not.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/method/size_tree.hpp"
#include "reference/scene_octree/size_classes.hpp"

namespace broadside::reference {

struct alignas(32) BoxRecord {
  core::Box box;
  std::uint32_t id;
  std::uint32_t is_static;  // 0 or 1
};

struct Bucket {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint16_t size_class;
  std::uint8_t buffer;  // which of the two copies holds it
  bool is_one_point;    // all centers coincide: it cannot be split
  [[nodiscard]] std::uint32_t count() const { return end - begin; }
};

// Keeps its memory between calls. Works in the caller's oneTBB arena.
class BoxBuckets {
 public:
  // False when a box is not finite or inside out; then there are no buckets.
  [[nodiscard]] bool deal(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);

  // In order of class, then along the curve. No bucket is empty.
  [[nodiscard]] std::span<const Bucket> buckets() const { return buckets_; }
  [[nodiscard]] const BoxRecord* records(const Bucket& bucket) const {
    return records_[bucket.buffer].data() + bucket.begin;
  }
  [[nodiscard]] std::size_t class_count() const { return plan_.counts.size(); }

 private:
  // What one chunk of boxes adds to the survey.
  struct Survey {
    core::Box bounds = core::empty_box();
    std::array<std::uint32_t, core::kSizeBins> sizes{};
    bool is_sound = true;
  };

  [[nodiscard]] bool survey(std::span<const core::Box> boxes);
  void deal_all(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  // Splits one bucket in a grid over its own centers; the parts are appended in order.
  void split(const Bucket& bucket, bool alone, std::vector<Bucket>& parts);
  void split_until_small(const Bucket& bucket, std::vector<Bucket>& parts);
  void split_large();
  void join_small();

  std::vector<Survey> surveys_;
  Survey whole_;
  SizeClasses plan_;
  std::vector<std::uint32_t> bucket_of_;
  std::array<std::vector<BoxRecord>, 2> records_;
  std::vector<std::uint32_t> counts_;
  std::vector<Bucket> buckets_;
  std::vector<Bucket> next_buckets_;
};

}  // namespace broadside::reference
