#include "datasets/box_streams/box_sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"

namespace broadside::datasets {

using core::Box;

std::vector<Box> boxes_of_density(std::uint32_t n, std::uint64_t seed, double density) {
  RandomStream random(seed);
  const double width = cube_root(n / density);
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Triple center = drawn(random, 0.0, width);
    boxes.push_back(box_of(center, drawn(random, 0.5, 1.5)));
  }
  return boxes;
}

std::vector<Box> boxes_of_size_ratio(std::uint32_t n, std::uint64_t seed, double ratio) {
  RandomStream random(seed);
  // The inverse of the cumulative distribution 1 - 1 / s^2. Moments are computed from the drawn sizes, because their
  // formulas need a logarithm, whose last bit differs between libraries.
  std::vector<double> sizes(n);
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;
  for (double& s : sizes) {
    s = std::min(ratio, 1.0 / std::sqrt(1.0 - random.unit()));
    first += s / n;
    second += s * s / n;
    third += s * s * s / n;
  }
  const double width = cube_root(n * (2.0 * third + 6.0 * second * first) / 8.0);
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (const double s : sizes) {
    const Triple center = drawn(random, 0.0, width);
    boxes.push_back(box_of(center, drawn(random, 0.8 * s, 1.2 * s)));
  }
  return boxes;
}

std::vector<Box> boxes_of_gap(std::uint32_t n, std::uint64_t seed, double gap) {
  RandomStream random(seed);
  const double width = cube_root(n / 16.0);
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t cube = random.below(16);
    Triple center = drawn(random, 0.0, width);
    center[0] += gap * width * (cube % 4);
    const std::uint32_t row = cube / 4;
    center[1] += gap * width * row;
    boxes.push_back(box_of(center, drawn(random, 0.5, 1.5)));
  }
  return boxes;
}

}  // namespace broadside::datasets
