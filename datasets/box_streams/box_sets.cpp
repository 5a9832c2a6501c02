#include "datasets/box_streams/box_sets.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "datasets/box_streams/box_of.hpp"
#include "datasets/cube_root.hpp"

namespace broadside::datasets {
namespace {

using core::Box;

struct MovingState {
  RandomStream random{0};
  double width = 0.0;
  double teleport_share = 0.0;
  std::vector<Triple> centers;
  std::vector<Triple> sides;
  std::vector<Triple> steps;

  void advance(std::vector<Box>& boxes) {
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      if (teleport_share > 0.0 && random.unit() < teleport_share) {
        centers[n] = drawn(random, 0.0, width);
      } else {
        for (int k = 0; k < 3; ++k) {
          centers[n][k] += steps[n][k];
          if (centers[n][k] < 0.0 || centers[n][k] > width) steps[n][k] = -steps[n][k];
        }
      }
      boxes[n] = box_of(centers[n], sides[n]);
    }
  }
};

}  // namespace

std::vector<Box> uniform_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  const double width = cube_root(n);
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Triple center = drawn(random, 0.0, width);
    boxes.push_back(box_of(center, drawn(random, 0.5, 1.5)));
  }
  return boxes;
}

std::vector<Box> heap_boxes(std::uint32_t n, std::uint64_t seed) {
  constexpr std::uint32_t kHeaps = 16;
  RandomStream random(seed);
  const auto in_heap = static_cast<std::uint32_t>(std::uint64_t{n} * 99 / 100 / kHeaps);
  // A cone as high as its radius holds pi r^3 / 3 lattice points of spacing 1.
  const double radius = cube_root(3.0 * in_heap / std::numbers::pi);
  const double width = std::max(16.0 * radius, 1.0);
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t heap = 0; heap < kHeaps; ++heap) {
    const std::uint32_t row = heap / 4;
    const double x0 = 4.0 * radius * (heap % 4 + 0.5);
    const double y0 = 4.0 * radius * (row + 0.5);
    std::uint32_t left = in_heap;
    for (double z = 0.0; left > 0; z += 1.0) {
      const double r = std::max(1.0, radius - z);
      const auto edge = static_cast<std::int64_t>(r);
      for (std::int64_t column = -edge; column <= edge; ++column) {
        for (std::int64_t line = -edge; line <= edge && left > 0; ++line) {
          const auto x = static_cast<double>(column);
          const auto y = static_cast<double>(line);
          if (x * x + y * y > r * r) continue;
          const Triple shift = drawn(random, -0.1, 0.1);
          boxes.push_back(box_of({x0 + x + shift[0], y0 + y + shift[1], z + shift[2]}, drawn(random, 0.84, 1.24)));
          --left;
        }
      }
    }
  }
  while (boxes.size() < n) {
    const double x = random.between(0.0, 64.0 * width);
    const double y = random.between(0.0, 64.0 * width);
    boxes.push_back(box_of({x, y, 0.5}, drawn(random, 0.84, 1.24)));
  }
  for (std::uint32_t k = n; k > 1; --k) std::swap(boxes[k - 1], boxes[random.below(k)]);
  return boxes;
}

std::vector<Box> mixed_boxes(std::uint32_t n, std::uint64_t seed) {
  RandomStream random(seed);
  const double width = cube_root(520.0 * n);
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Triple center = drawn(random, 0.0, width);
    // The inverse of the cumulative distribution 1 - 1 / s^2.
    const double pareto = std::min(1000.0, 1.0 / std::sqrt(1.0 - random.unit()));
    const double s = k == n / 2 ? 1000.0 : pareto;
    boxes.push_back(box_of(center, drawn(random, 0.8 * s, 1.2 * s)));
  }
  return boxes;
}

BoxStream moving_boxes(std::uint32_t n, std::uint64_t seed, std::uint32_t frames, double teleport_share) {
  // The same draws as uniform_boxes, so that frame 0 is that set.
  RandomStream places(seed);
  auto state = std::make_shared<MovingState>();
  state->random = RandomStream(core::splitmix64(seed));
  state->width = cube_root(n);
  state->teleport_share = teleport_share;
  BoxStream stream;
  stream.frames = frames;
  for (std::uint32_t k = 0; k < n; ++k) {
    const Triple center = drawn(places, 0.0, state->width);
    const Triple sides = drawn(places, 0.5, 1.5);
    const RandomStream::Direction d = state->random.direction();
    const double step = 0.01 * ((sides[0] + sides[1]) + sides[2]) / 3.0;
    state->centers.push_back(center);
    state->sides.push_back(sides);
    state->steps.push_back({step * d.x, step * d.y, step * d.z});
    stream.boxes.push_back(box_of(center, sides));
  }
  stream.advance = [state](std::vector<Box>& boxes) {
    state->advance(boxes);
    return core::Status(core::Done{});
  };
  return stream;
}

}  // namespace broadside::datasets
