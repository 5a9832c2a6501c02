// A set of boxes cut into ranges of space, each searched on its own: one after another where a set does not fit in
// memory, or in parallel on several devices, processes or machines. Parts exchange nothing: each part follows from the
// cut, its number and the boxes, and together their pairs are those of the set, each once.
//
// A cut has one axis and faces on it. A part contains every box that reaches into its range. A pair belongs to the part
// that contains the larger of its boxes' two lower bounds on that axis. Both boxes are in that part: each begins at
// that bound or before it and, since the boxes overlap, ends at it or after it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"

namespace broadside::core {

struct SpaceCut {
  int axis = 0;
  std::vector<float> faces;  // rising; part k is the range from faces[k - 1] up to, but not including, faces[k]

  [[nodiscard]] std::uint32_t parts() const { return static_cast<std::uint32_t>(faces.size()) + 1U; }
  [[nodiscard]] std::uint32_t part_at(float x_m) const {
    return static_cast<std::uint32_t>(std::upper_bound(faces.begin(), faces.end(), x_m) - faces.begin());
  }
  // part_at(b.min) <= part <= part_at(b.max), computed from the part's own two faces alone.
  [[nodiscard]] bool reaches(const Box& b, std::uint32_t part) const {
    return (part == faces.size() || b.min[axis] < faces[part]) && (part == 0 || faces[part - 1] <= b.max[axis]);
  }
  // The part to which a pair of overlapping boxes belongs.
  [[nodiscard]] std::uint32_t part_of_pair(const Box& a, const Box& b) const {
    return part_at(std::max(a.min[axis], b.min[axis]));
  }
};

// Chooses faces between which about equally many boxes begin, on the axis on which the largest part is smallest. parts
// >= 1; computed from a sample of at most 65,536 boxes.
SpaceCut cut_space(std::span<const Box> boxes, std::uint32_t parts);

// The boxes of one part, in the set's order. Ids are below 2^32, like those of the whole set.
struct BoxPart {
  std::vector<Box> boxes;
  std::vector<std::uint8_t> is_static;
  std::vector<std::uint32_t> ids;  // of each box in the whole set
};
BoxPart part_of(const SpaceCut& cut, std::uint32_t part, std::span<const Box> boxes,
                std::span<const std::uint8_t> is_static);

// From the pairs that a search of this part found, keeps those that belong to the part, and replaces the part's box
// numbers by the set's.
void keep_own_pairs(const SpaceCut& cut, std::uint32_t part, const BoxPart& boxes, std::vector<Pair>& pairs);

}  // namespace broadside::core
