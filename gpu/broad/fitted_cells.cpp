#include "gpu/broad/fitted_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gpu/broad/shared_boxes.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

constexpr std::size_t kSample = 1024;
// From this many boxes on a sample of a thousand boxes has no neighbors in it. Then a thousand boxes look for partners
// in a larger sample.
constexpr std::size_t kLeastForLookers = 1U << 20U;
constexpr std::size_t kBoxesPerSampled = 64;
constexpr std::size_t kMostSampled = 1U << 20U;
// They are half an octave apart.
constexpr std::array<float, 4> kScales{1.0F, 1.41421356F, 2.0F, 2.82842712F};
// With fewer tests counted in the sample, their number is off by a tenth by chance.
constexpr double kLeastCounted = 100.0;
constexpr double kWorthwhile = 0.8;
// Looking up a row of cells costs as much as reading four of its entries, which is what a lane reads at once.
constexpr double kTestsOfRow = 4.0;
// Levels that are told apart, coarsest first: boxes on finer levels count as boxes of the last one.
constexpr int kLevels = 10;

struct Cells {
  double largest_m = 1.0;
  int levels_apart = 2;
  [[nodiscard]] double size_m(int level) const { return std::ldexp(largest_m, -levels_apart * level); }
};

// A box as the search sees it: its level, counted from the coarsest in steps of `levels_apart`, its cell there, and for
// each level the cells that it looks at.
struct Seen {
  int level = 0;
  std::int64_t cell[3] = {};
  std::int64_t low[kLevels][3] = {};
  std::int64_t high[kLevels][3] = {};
};

std::int64_t cell_at(float v, double cell_m) {
  // The search, too, takes all cells beyond this for one.
  constexpr double kFarthest = 1e9;
  return static_cast<std::int64_t>(std::clamp(std::floor(static_cast<double>(v) / cell_m), -kFarthest, kFarthest));
}

Seen seen(const Box& box, const Cells& cells) {
  Seen s;
  const core::Vec3 side = box.max - box.min;
  const double needed = std::max({side.x, side.y, side.z});
  while (s.level + 1 < kLevels && cells.size_m(s.level + 1) >= needed) ++s.level;
  for (int level = 0; level <= s.level; ++level) {
    const double cell_m = cells.size_m(level);
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

// The work of looking for partners of a sample of boxes.
struct Looked {
  double tests = 0.0;  // tests of pairs within the sample
  double rows = 0.0;   // rows of cells, per box
};

std::uint32_t levels_of(const std::vector<Seen>& sample) {
  std::uint32_t levels = 0;
  for (const Seen& s : sample) levels |= 1U << static_cast<unsigned>(s.level);
  return levels;
}

// Rows of cells that a box looks at. On its own level these are about half of those around it, since of two boxes of
// one level only one looks for the other.
double rows_of(const Seen& s, std::uint32_t levels) {
  double rows = 0.0;
  for (int level = 0; level <= s.level; ++level) {
    if ((levels >> static_cast<unsigned>(level) & 1U) == 0) continue;
    const auto cells = [&](int axis) { return static_cast<double>(s.high[level][axis] - s.low[level][axis] + 1); };
    rows += (level == s.level ? 0.5 : 1.0) * cells(1) * cells(2);
  }
  return rows;
}

// A key for a cell of a level. Cells whose numbers differ by a multiple of 2^20 have one key, but are seldom both in a
// sample. Neighbors in z have consecutive keys, except for one in 2^20, far from the origin.
std::uint64_t key_of(int level, std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (1U << 20U) - 1U;
  const auto bits = [](std::int64_t v) { return static_cast<std::uint64_t>(v + (1 << 19)) & kMask; };
  return ((static_cast<std::uint64_t>(level) << 20U | bits(x)) << 20U | bits(y)) << 20U | bits(z);
}

// The work of some boxes of the sample, evenly chosen, that look for partners in the whole sample. It is counted as the
// search does it: a box tests boxes of coarser levels, and of two boxes of one level only one tests the other. So it is
// a share of the work of all.
Looked look_by_some(const std::vector<Box>& sample, const Cells& shape) {
  std::vector<std::uint64_t> cells;
  cells.reserve(sample.size());
  std::uint32_t levels = 0;
  for (const Box& box : sample) {
    const Seen s = seen(box, shape);
    cells.push_back(key_of(s.level, s.cell[0], s.cell[1], s.cell[2]));
    levels |= 1U << static_cast<unsigned>(s.level);
  }
  std::sort(cells.begin(), cells.end());
  Looked all;
  for (std::size_t k = 0; k < kSample; ++k) {
    const Seen s = seen(sample[k * sample.size() / kSample], shape);
    all.rows += rows_of(s, levels) / static_cast<double>(kSample);
    for (int level = 0; level <= s.level; ++level) {
      if ((levels >> static_cast<unsigned>(level) & 1U) == 0) continue;
      const double weight = level == s.level ? 0.5 : 1.0;
      for (std::int64_t x = s.low[level][0]; x <= s.high[level][0]; ++x)
        for (std::int64_t y = s.low[level][1]; y <= s.high[level][1]; ++y) {
          const auto first = std::lower_bound(cells.begin(), cells.end(), key_of(level, x, y, s.low[level][2]));
          const auto last = std::upper_bound(first, cells.end(), key_of(level, x, y, s.high[level][2]));
          all.tests += weight * static_cast<double>(last - first);
        }
    }
    all.tests -= 0.5;  // itself
  }
  return all;
}

// The work of all boxes of the sample: pairs of which one box looks at the other.
Looked look_by_all(const std::vector<Box>& sample, const Cells& cells) {
  std::vector<Seen> all;
  all.reserve(sample.size());
  for (const Box& box : sample) all.push_back(seen(box, cells));
  std::uint64_t tests = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      tests += (all[i].level >= all[j].level ? looks_at(all[i], all[j]) : looks_at(all[j], all[i])) ? 1 : 0;
  Looked looked;
  looked.tests = static_cast<double>(tests);
  const std::uint32_t levels = levels_of(all);
  for (const Seen& s : all) looked.rows += rows_of(s, levels) / static_cast<double>(all.size());
  return looked;
}

// One lane finishes a row of cells with fewer tests than this in one step or two; three more lanes would only wait.
constexpr double kLongRow = 10.0;
// With more boxes every warp takes boxes several times, and a warp in a crowd does not take longer than all the others
// do.
constexpr std::uint32_t kMostSharedBoxes = 300'000;

// Where a box has this many tests in its cells, searching by groups of neighboring boxes is faster: on one H100 spheres
// with 40 tests a box take 0.090 instead of 0.099 ms, uniform boxes with 30 take 0.066 instead of 0.055.
constexpr double kTestsForGroups = 35.0;
// Groups take some 50 bytes a box more.
constexpr std::uint32_t kMostGroupedBoxes = 16'000'000;

}  // namespace

BulkFit bulk_fit(std::span<const Box> boxes, const BoxFacts& facts) {
  std::vector<Box> sample;
  for (const std::uint32_t k : boxes_to_fit_by(boxes.size())) sample.push_back(boxes[k]);
  return bulk_fit_by_sample(sample, facts);
}

std::vector<std::uint32_t> boxes_to_fit_by(std::size_t count) {
  std::vector<std::uint32_t> which;
  if (count < 2 * kSample) return which;
  const bool has_lookers = count >= kLeastForLookers;
  const std::size_t size = has_lookers ? std::min(count / kBoxesPerSampled, kMostSampled) : kSample;
  which.reserve(size);
  for (std::size_t k = 0; k < size; ++k) which.push_back(static_cast<std::uint32_t>(k * count / size));
  return which;
}

BulkFit bulk_fit_by_sample(const std::vector<Box>& sample, const BoxFacts& facts) {
  BulkFit fit;
  if (sample.empty() || !(facts.largest_side_m > 0.0F)) return fit;
  const auto look = sample.size() > kSample ? look_by_some : look_by_all;
  Looked best;
  double worthwhile = 0.0;
  for (const float scale : kScales) {
    const Looked looked = look(sample, {static_cast<double>(facts.largest_side_m) * scale, 2});
    if (scale == 1.0F) {
      best = looked;
      if (looked.tests < kLeastCounted) break;
      worthwhile = kWorthwhile * looked.tests;
    } else if (looked.tests < std::min(best.tests, worthwhile)) {
      best = looked;
      fit.cell_scale = scale;
    }
  }
  // Each box of the sample stands for this many boxes, so its cells have that many times as many others.
  const double boxes_per_sampled = static_cast<double>(facts.count) / static_cast<double>(sample.size());
  const auto tests_a_box = [&](const Looked& l) { return l.tests / static_cast<double>(kSample) * boxes_per_sampled; };
  const auto cost = [&](const Looked& l) { return kTestsOfRow * l.rows + tests_a_box(l); };
  // Levels farther apart mean fewer rows of cells to look at, but larger cells for some boxes.
  const double largest_m = static_cast<double>(facts.largest_side_m) * static_cast<double>(fit.cell_scale);
  const Looked sparse = look(sample, {largest_m, 4});
  if (cost(sparse) <= kWorthwhile * cost(best)) {
    fit.levels_apart = 4;
    best = sparse;
  }
  if (best.tests < kLeastCounted) return fit;
  if (facts.count <= kMostSharedBoxes && tests_a_box(best) >= kLongRow * best.rows) {
    fit.lanes_per_box = kLanesOfCrowd;
    fit.x_halvings = 1;
  }
  fit.is_grouped = facts.count <= kMostGroupedBoxes && tests_a_box(best) >= kTestsForGroups;
  return fit;
}

}  // namespace broadside::gpu
