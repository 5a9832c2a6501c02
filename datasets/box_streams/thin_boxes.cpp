#include "datasets/box_streams/thin_boxes.hpp"

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"

namespace broadside::datasets {
namespace {

// Sides with `length` along an axis drawn at random.
Triple thin_sides(RandomStream& random, double length, double thickness) {
  Triple sides{thickness, thickness, thickness};
  sides[random.below(3)] = length;
  return sides;
}

}  // namespace

std::vector<core::Box> needle_boxes(std::uint32_t n, std::uint64_t seed) {
  constexpr double kLength_m = 100.0;
  constexpr double kThickness_m = 1e-4;
  RandomStream random(seed);
  std::vector<core::Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Triple center = drawn(random, 0.0, kLength_m);
    boxes.push_back(box_of(center, thin_sides(random, kLength_m, kThickness_m)));
  }
  return boxes;
}

std::vector<core::Box> sliver_boxes(std::uint32_t n, std::uint64_t seed) {
  constexpr double kThinner = 1000.0;
  RandomStream random(seed);
  // Two boxes of length 1 along different axes, as in two of three pairs, overlap within a volume of 1 * 1 * 2 / 1000.
  const double width = cube_root(2.0 / 3.0 * 2.0 / kThinner / 8.0 * n);
  std::vector<core::Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Triple center = drawn(random, 0.0, width);
    const double length = random.between(0.5, 1.5);
    boxes.push_back(box_of(center, thin_sides(random, length, length / kThinner)));
  }
  return boxes;
}

}  // namespace broadside::datasets
