// The second half of building the tree: the boxes of one bucket in order along the Hilbert curve.
#pragma once

#include <span>
#include <vector>

#include "reference/scene_octree/box_buckets.hpp"
#include "reference/scene_octree/key_sort.hpp"

namespace broadside::reference {

// The memory of one worker for this.
class CurveOrder {
 public:
  // Places 0 .. count-1 in order; valid until the next call.
  std::span<const KeyedId> order(const BoxRecord* records, std::uint32_t count);

 private:
  void order_part(const BoxRecord* records, std::size_t begin, std::size_t end);

  std::vector<KeyedId> entries_;  // place in the bucket, under a key that is no longer needed
  std::vector<KeyedId> scratch_;
};

}  // namespace broadside::reference
