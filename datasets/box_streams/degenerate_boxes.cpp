#include "datasets/box_streams/degenerate_boxes.hpp"

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"

namespace broadside::datasets {
namespace {

using core::Box;
using Boxes = std::vector<Box>;

// uniform_boxes with each coordinate mapped before it is rounded to float.
template <typename Map>
Boxes mapped_uniform(std::uint32_t n, std::uint64_t seed, const Map& map) {
  RandomStream random(seed);
  const double width = cube_root(n);
  Boxes boxes;
  boxes.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Triple center = drawn(random, 0.0, width);
    const Triple sides = drawn(random, 0.5, 1.5);
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.min[k] = static_cast<float>(map(center[k] - 0.5 * sides[k]));
      box.max[k] = static_cast<float>(map(center[k] + 0.5 * sides[k]));
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

Boxes identical_boxes(std::uint32_t n) {
  return {n, Box{{0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}}};
}

Boxes touching_boxes(std::uint32_t n) {
  std::uint64_t width = 1;
  while (width * width * width < n) ++width;
  Boxes boxes;
  boxes.reserve(n);
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::uint64_t layer = i / (width * width);
    const core::Vec3 low{static_cast<float>(i % width), static_cast<float>(i / width % width),
                         static_cast<float>(layer)};
    boxes.push_back({low, low + core::Vec3{1.0F, 1.0F, 1.0F}});
  }
  return boxes;
}

Boxes line_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  Boxes boxes;
  boxes.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double x = random.between(0.0, 0.25 * n);
    boxes.push_back(box_of({x, 0.0, 0.0}, drawn(random, 0.5, 1.5)));
  }
  return boxes;
}

Boxes plane_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  const double width = std::sqrt(0.5 * n);
  Boxes boxes;
  boxes.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double x = random.between(0.0, width);
    const double y = random.between(0.0, width);
    boxes.push_back(box_of({x, y, 0.0}, drawn(random, 0.5, 1.5)));
  }
  return boxes;
}

Boxes flat_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  const auto width = static_cast<std::uint32_t>(cube_root(n)) + 1;
  Boxes boxes;
  boxes.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    core::Vec3 low;
    for (int k = 0; k < 3; ++k) low[k] = static_cast<float>(random.below(width));
    const core::Vec3 sides{i % 3 == 0 ? 0.0F : 1.0F, i % 3 == 2 ? 1.0F : 0.0F, 0.0F};
    boxes.push_back({low, low + sides});
  }
  return boxes;
}

Boxes far_boxes(std::uint32_t n, std::uint64_t seed) {
  return mapped_uniform(n, seed, [](double v) { return v + 1e6; });
}

Boxes tiny_boxes(std::uint32_t n, std::uint64_t seed) {
  return mapped_uniform(n, seed, [](double v) { return v * 1e-6; });
}

Boxes subnormal_boxes(std::uint32_t n, std::uint64_t seed) {
  return mapped_uniform(n, seed, [](double v) { return v * 0x1p-140; });
}

}  // namespace broadside::datasets
