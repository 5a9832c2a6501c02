#include "core/engine/space_parts.hpp"

#include <cstddef>
#include <utility>

namespace broadside::core {
namespace {

constexpr std::size_t kMostLookedAt = 65'536;

SpaceCut cut_along(int axis, const std::vector<Box>& sample, std::uint32_t parts) {
  std::vector<float> begins;
  begins.reserve(sample.size());
  for (const Box& b : sample) begins.push_back(b.min[axis]);
  std::sort(begins.begin(), begins.end());
  SpaceCut cut{axis, {}};
  for (std::uint32_t k = 1; k < parts; ++k) cut.faces.push_back(begins[begins.size() * k / parts]);
  return cut;
}

// The number of boxes in the largest part.
std::size_t largest_part(const SpaceCut& cut, const std::vector<Box>& sample) {
  // Change in the number of boxes from each part to the next.
  std::vector<std::ptrdiff_t> change(cut.parts() + std::size_t{1});
  for (const Box& b : sample) {
    ++change[cut.part_at(b.min[cut.axis])];
    --change[cut.part_at(b.max[cut.axis]) + std::size_t{1}];
  }
  std::ptrdiff_t most = 0;
  std::ptrdiff_t here = 0;
  for (const std::ptrdiff_t c : change) here += c, most = std::max(most, here);
  return static_cast<std::size_t>(most);
}

}  // namespace

SpaceCut cut_space(std::span<const Box> boxes, std::uint32_t parts) {
  if (parts <= 1 || boxes.empty()) return {};
  std::vector<Box> sample;
  const std::size_t stride = (boxes.size() + kMostLookedAt - 1) / kMostLookedAt;
  for (std::size_t k = 0; k < boxes.size(); k += stride) sample.push_back(boxes[k]);
  SpaceCut best = cut_along(0, sample, parts);
  for (int axis = 1; axis < 3; ++axis) {
    SpaceCut cut = cut_along(axis, sample, parts);
    if (largest_part(cut, sample) < largest_part(best, sample)) best = std::move(cut);
  }
  return best;
}

BoxPart part_of(const SpaceCut& cut, std::uint32_t part, std::span<const Box> boxes,
                std::span<const std::uint8_t> is_static) {
  BoxPart own;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!cut.reaches(boxes[i], part)) continue;
    own.boxes.push_back(boxes[i]);
    own.is_static.push_back(is_static[i]);
    own.ids.push_back(static_cast<std::uint32_t>(i));
  }
  return own;
}

void keep_own_pairs(const SpaceCut& cut, std::uint32_t part, const BoxPart& boxes, std::vector<Pair>& pairs) {
  std::size_t kept = 0;
  for (const Pair p : pairs)
    if (cut.part_of_pair(boxes.boxes[p.i], boxes.boxes[p.j]) == part)
      // The part's boxes are in the set's order, so i < j still holds.
      pairs[kept++] = {boxes.ids[p.i], boxes.ids[p.j]};
  pairs.resize(kept);
}

}  // namespace broadside::core
