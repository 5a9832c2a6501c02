#include "datasets/box_streams/uneven_boxes.hpp"

#include <cmath>
#include <utility>

#include "datasets/box_streams/box_of.hpp"
#include "datasets/circle.hpp"

namespace broadside::datasets {

std::vector<core::Box> spiral_boxes(std::uint32_t n, std::uint64_t seed) {
  constexpr std::uint64_t kTurns = 64;
  constexpr double kPi = 3.14159265358979323846;
  RandomStream random(seed);
  std::vector<core::Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    // In units of the outer radius, so that a set of any count has the same shape.
    const double share = static_cast<double>(k) / n;
    const double radius = share * share;
    const Turn at = part_of_circle(static_cast<std::uint32_t>(k * kTurns % n), n);
    const double along = 2.0 * kPi * static_cast<double>(kTurns) * radius / n;
    const double outward = 2.0 * share / n;
    const double side = 1.5 * std::sqrt(along * along + outward * outward);
    boxes.push_back(box_of({radius * at.cosine, radius * at.sine, 0.0}, {side, side, side}));
  }
  for (std::uint32_t k = n; k > 1; --k) std::swap(boxes[k - 1], boxes[random.below(k)]);
  return boxes;
}

std::vector<core::Box> cantor_boxes(std::uint32_t n, std::uint64_t seed) {
  // Digits after the point: 3^-8 is far below a side.
  constexpr int kFine = 8;
  int whole = 0;
  for (std::uint64_t cubes = 1; cubes < n; cubes *= 8) ++whole;
  RandomStream random(seed);
  double last_place = 1.0;
  for (int k = 0; k < kFine; ++k) last_place /= 3.0;
  std::vector<core::Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    Triple center;
    for (double& c : center) {
      const std::uint64_t digits = random.bits();
      std::uint64_t number = 0;
      for (int d = 0; d < whole + kFine; ++d) number = 3 * number + 2 * (digits >> d & 1U);
      c = static_cast<double>(number) * last_place;
    }
    boxes.push_back(box_of(center, drawn(random, 0.5, 1.5)));
  }
  return boxes;
}

std::vector<core::Box> exponent_boxes(std::uint32_t n, std::uint64_t seed) {
  constexpr int kLeastScale = -140;
  constexpr std::uint32_t kScales = 265;
  constexpr int kMostFiner = 13;
  RandomStream random(seed);
  std::vector<core::Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const int scale = kLeastScale + static_cast<int>(random.below(kScales));
    const int finer = 3 + static_cast<int>(random.below(kMostFiner - 2));
    const Triple center = drawn(random, -1.0, 1.0);
    const Triple sides = drawn(random, 1.0, 2.0);
    core::Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = std::ldexp(0.5 * sides[axis], -finer);
      box.min[axis] = static_cast<float>(std::ldexp(center[axis] - half, scale));
      box.max[axis] = static_cast<float>(std::ldexp(center[axis] + half, scale));
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace broadside::datasets
