#include "gpu/broad/fitted_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace broadside::gpu {
namespace {

using core::Box;

constexpr std::size_t kSample = 1024;
// Half an octave apart.
constexpr std::array<float, 4> kScales{1.0F, 1.41421356F, 2.0F, 2.82842712F};
// Tests that were counted in the sample: below, their number is off by a tenth by chance.
constexpr double kLeastCounted = 100.0;
constexpr double kWorthwhile = 0.8;
// Levels of cells, finest first out of reach: a box smaller than 4^-10 of the largest is as good as that.
constexpr int kLevels = 10;

// A box as the search sees it: its level, counted in halvings by two, its cell there, and for each level the cells that
// it looks at.
struct Seen {
  int level = 0;
  std::int64_t cell[3] = {};
  std::int64_t low[kLevels][3] = {};
  std::int64_t high[kLevels][3] = {};
};

std::int64_t cell_at(float v, double cell_m) {
  // Beyond this, cells of the search are one, too.
  constexpr double kFarthest = 1e9;
  return static_cast<std::int64_t>(std::clamp(std::floor(static_cast<double>(v) / cell_m), -kFarthest, kFarthest));
}

Seen seen(const Box& box, double largest_cell_m) {
  Seen s;
  const core::Vec3 side = box.max - box.min;
  const double needed = std::max({side.x, side.y, side.z});
  while (s.level + 1 < kLevels && std::ldexp(largest_cell_m, -2 * (s.level + 1)) >= needed) ++s.level;
  for (int level = 0; level <= s.level; ++level) {
    const double cell_m = std::ldexp(largest_cell_m, -2 * level);
    for (int k = 0; k < 3; ++k) {
      s.low[level][k] = cell_at(box.min[k], cell_m) - 1;
      s.high[level][k] = cell_at(box.max[k], cell_m);
    }
  }
  for (int k = 0; k < 3; ++k) s.cell[k] = s.low[s.level][k] + 1;
  return s;
}

bool looks_at(const Seen& a, const Seen& b) {
  const auto& low = a.low[b.level];
  const auto& high = a.high[b.level];
  return low[0] <= b.cell[0] && b.cell[0] <= high[0] && low[1] <= b.cell[1] && b.cell[1] <= high[1] &&
         low[2] <= b.cell[2] && b.cell[2] <= high[2];
}

// Pairs of the sample of which one looks at the other.
double tests_of(const std::vector<Box>& sample, double largest_cell_m) {
  std::vector<Seen> all;
  all.reserve(sample.size());
  for (const Box& box : sample) all.push_back(seen(box, largest_cell_m));
  std::uint64_t tests = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      tests += (all[i].level >= all[j].level ? looks_at(all[i], all[j]) : looks_at(all[j], all[i])) ? 1 : 0;
  return static_cast<double>(tests);
}

}  // namespace

float fitted_cell_scale(std::span<const Box> boxes, const BoxFacts& facts) {
  std::vector<Box> sample;
  for (const std::uint32_t k : boxes_to_fit_by(boxes.size())) sample.push_back(boxes[k]);
  return cell_scale_by_sample(sample, facts);
}

std::vector<std::uint32_t> boxes_to_fit_by(std::size_t count) {
  std::vector<std::uint32_t> which;
  if (count < 2 * kSample) return which;
  for (std::size_t k = 0; k < kSample; ++k) which.push_back(static_cast<std::uint32_t>(k * count / kSample));
  return which;
}

float cell_scale_by_sample(const std::vector<Box>& sample, const BoxFacts& facts) {
  if (sample.empty() || !(facts.largest_side_m > 0.0F)) return 1.0F;
  double least = 0.0;
  float best = 1.0F;
  for (const float scale : kScales) {
    const double tests = tests_of(sample, static_cast<double>(facts.largest_side_m) * scale);
    if (scale == 1.0F) {
      if (tests < kLeastCounted) return 1.0F;
      least = kWorthwhile * tests;
    } else if (tests < least) {
      least = tests;
      best = scale;
    }
  }
  return best;
}

}  // namespace broadside::gpu
