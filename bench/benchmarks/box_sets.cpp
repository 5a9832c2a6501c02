#include "bench/benchmarks/box_sets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datasets/random.hpp"

namespace broadside::bench {
namespace {

using core::Box;
using datasets::RandomStream;

constexpr double kPi = 3.14159265358979323846;

struct Point {
  double x, y, z;
};

Box box_of(const Point& center, double side_x, double side_y, double side_z) {
  return {{static_cast<float>(center.x - 0.5 * side_x), static_cast<float>(center.y - 0.5 * side_y),
           static_cast<float>(center.z - 0.5 * side_z)},
          {static_cast<float>(center.x + 0.5 * side_x), static_cast<float>(center.y + 0.5 * side_y),
           static_cast<float>(center.z + 0.5 * side_z)}};
}

Box with_sides_between(RandomStream& random, const Point& center, double low, double high) {
  const double x = random.between(low, high);
  const double y = random.between(low, high);
  return box_of(center, x, y, random.between(low, high));
}

Point in_cube(RandomStream& random, double side) {
  const double x = random.between(0, side);
  const double y = random.between(0, side);
  return {x, y, random.between(0, side)};
}

}  // namespace

std::vector<Box> uniform_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  const double side = std::cbrt(n);
  std::vector<Box> boxes;
  for (std::uint32_t k = 0; k < n; ++k) {
    const Point center = in_cube(random, side);
    boxes.push_back(with_sides_between(random, center, 0.5, 1.5));
  }
  return boxes;
}

std::vector<Box> heap_boxes(std::uint32_t n, std::uint64_t seed) {
  constexpr std::uint32_t kHeaps = 16;
  RandomStream random(seed);
  const auto jitter = [&] { return random.between(-0.1, 0.1); };
  const std::uint32_t in_heap = n / 100U * 99U / kHeaps;
  // A cone as high as its radius holds pi r^3 / 3.
  const double radius = std::cbrt(3.0 * in_heap / kPi);
  const double width = 16.0 * radius;
  std::vector<Box> boxes;
  for (std::uint32_t heap = 0; heap < kHeaps; ++heap) {
    const double x0 = 4.0 * radius * (heap % 4 + 0.5);
    const double y0 = 4.0 * radius * (heap / 4 + 0.5);
    std::uint32_t left = in_heap;
    for (double z = 0; left > 0; z += 1.0) {
      const double r = std::max(1.0, radius - z);
      for (double x = -std::floor(r); x <= r; x += 1.0)
        for (double y = -std::floor(r); y <= r && left > 0; y += 1.0) {
          if (x * x + y * y > r * r) continue;
          const double dx = jitter();
          const double dy = jitter();
          boxes.push_back(with_sides_between(random, {x0 + x + dx, y0 + y + dy, z + jitter()}, 0.84, 1.24));
          --left;
        }
    }
  }
  while (boxes.size() < n) {
    const double x = random.between(0, 64.0 * width);
    boxes.push_back(with_sides_between(random, {x, random.between(0, 64.0 * width), 0.5}, 0.84, 1.24));
  }
  for (std::uint32_t k = n; k > 1; --k) std::swap(boxes[k - 1], boxes[random.below(k)]);
  return boxes;
}

std::vector<Box> mixed_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  const double side = std::cbrt(520.0 * n);
  std::vector<Box> boxes;
  for (std::uint32_t k = 0; k < n; ++k) {
    const Point center = in_cube(random, side);
    const double drawn = std::min(1000.0, 1.0 / std::sqrt(1.0 - random.unit()));
    const double s = k == n / 2 ? 1000.0 : drawn;
    boxes.push_back(with_sides_between(random, center, 0.8 * s, 1.2 * s));
  }
  return boxes;
}

}  // namespace broadside::bench
