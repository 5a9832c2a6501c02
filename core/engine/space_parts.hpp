// A set of boxes cut into ranges of space that are searched each alone: one after another where a set does not fit, or
// on as many devices, processes and machines as there are. Nothing passes between parts: each follows from the cut, its
// number and the boxes, and their pairs together are those of the set, each once.
//
// A cut has one axis and faces on it. A part has every box that reaches into its range; a pair belongs to the part in
// which the larger of its two lower corners lies. There both boxes are: each begins before that corner or in it, and
// ends behind it or in it, since they overlap.
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
  std::vector<float> faces;  // in order; part k is from faces[k - 1] on, up to before faces[k]

  [[nodiscard]] std::uint32_t parts() const { return static_cast<std::uint32_t>(faces.size()) + 1U; }
  [[nodiscard]] std::uint32_t part_at(float x_m) const {
    return static_cast<std::uint32_t>(std::upper_bound(faces.begin(), faces.end(), x_m) - faces.begin());
  }
  // part_at(b.min) <= part <= part_at(b.max), by a look at the part's own two faces.
  [[nodiscard]] bool reaches(const Box& b, std::uint32_t part) const {
    return (part == faces.size() || b.min[axis] < faces[part]) && (part == 0 || faces[part - 1] <= b.max[axis]);
  }
  // Of two that overlap.
  [[nodiscard]] std::uint32_t part_of_pair(const Box& a, const Box& b) const {
    return part_at(std::max(a.min[axis], b.min[axis]));
  }
};

// Faces between which about as many boxes begin, on the axis on which the largest part is smallest. parts >= 1; from a
// sample of at most 65,536 boxes.
SpaceCut cut_space(std::span<const Box> boxes, std::uint32_t parts);

// The boxes of one part, in their order. Numbers are below 2^32, as those of all boxes.
struct BoxPart {
  std::vector<Box> boxes;
  std::vector<std::uint8_t> is_static;
  std::vector<std::uint32_t> ids;  // in the set
};
BoxPart part_of(const SpaceCut& cut, std::uint32_t part, std::span<const Box> boxes,
                std::span<const std::uint8_t> is_static);

// Of the pairs that a search of this part found, by its numbers, those that belong to it, by the set's.
void keep_own_pairs(const SpaceCut& cut, std::uint32_t part, const BoxPart& boxes, std::vector<Pair>& pairs);

}  // namespace broadside::core
