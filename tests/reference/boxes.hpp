// Boxes for the tests of broad phases, and their pairs by searches written for the tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"

namespace broadside {

using core::Box;
using core::Pair;

// The overlap rule, written out a second time: closed intervals meet on all three axes.
inline bool meet(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::max(a.min[axis], b.min[axis]) > std::min(a.max[axis], b.max[axis])) return false;
  return true;
}

// One box ends on some axis exactly where the other begins.
inline bool only_touch(const Box& a, const Box& b) {
  const auto on = [](float a_min, float a_max, float b_min, float b_max) { return a_max == b_min || b_max == a_min; };
  return on(a.min.x, a.max.x, b.min.x, b.max.x) || on(a.min.y, a.max.y, b.min.y, b.max.y) ||
         on(a.min.z, a.max.z, b.min.z, b.max.z);
}

inline std::vector<Pair> brute_force(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if ((is_static[i] == 0 || is_static[j] == 0) && meet(boxes[i], boxes[j])) pairs.push_back({i, j});
  return pairs;
}

// Sort and sweep along x: a third way to the same set, fast enough for many boxes.
inline std::vector<Pair> sweep(const std::vector<Box>& boxes) {
  std::vector<std::uint32_t> order(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](auto p, auto q) { return boxes[p].min.x < boxes[q].min.x; });
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < order.size(); ++p)
    for (std::size_t q = p + 1; q < order.size() && boxes[order[q]].min.x <= boxes[order[p]].max.x; ++q)
      if (meet(boxes[order[p]], boxes[order[q]])) pairs.push_back(core::make_pair_of(order[p], order[q]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

inline std::vector<Box> random_boxes(std::mt19937& random, std::size_t n, float domain, float side) {
  std::uniform_real_distribution<float> at(0.0F, domain);
  std::uniform_real_distribution<float> size(0.0F, side);
  std::vector<Box> boxes(n);
  for (Box& b : boxes) {
    b.min = {at(random), at(random), at(random)};
    b.max = b.min + core::Vec3{size(random), size(random), size(random)};
  }
  return boxes;
}

}  // namespace broadside
