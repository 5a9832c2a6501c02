// The cost model. Two boxes of groups g and h are tested against each other when they lie in neighboring cells, whose
// size on each axis is that of the longer box. This happens with probability prod_k min(1, 2 max(m_gk, m_hk) / W_k),
// where m are mean sides and W is the world's width. Without passes a cell is cubic, so all three m are those of the
// longest side.
#include "core/method/box_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace broadside::core {
namespace {

// A sample of this size gives shares to within some 3 %, and costs 5 us.
constexpr std::uint32_t kSampled = 1024;
// An octree on a GPU has 21 levels, and its finest cells must hold some boxes each. It cannot divide a world that is
// this many times wider than the distance of its median box from the origin.
constexpr float kFarWider = 0x1p16F;
// Sorting a box and visiting its neighbors costs as much as this many tests.
constexpr double kTestsOfABox = 64.0;
// Passes must promise at least this gain, because the model does not know how boxes cluster.
constexpr double kLeastGain = 2.0;
// The mapped world is at most this many cells wide, so that the rounding of floats does not lose positions.
constexpr double kMostCells = 0x1p18;

struct BoxGroup {
  double share = 0.0;
  std::array<double, 3> side{};
  [[nodiscard]] double longest() const { return std::max({side[0], side[1], side[2]}); }
};

using Widths = std::array<double, 3>;

double chance(double reach, double width) {
  return width > 0.0 ? std::min(1.0, 2.0 * reach / width) : 1.0;
}
double cubic(const BoxGroup& a, const BoxGroup& b, const Widths& world) {
  double p = a.share * b.share;
  for (const double width : world) p *= chance(std::max(a.longest(), b.longest()), width);
  return p;
}
// Expected tests in a pass whose cells are as long on each axis as the sides of `c` and `d`.
double fitted(const BoxGroup& a, const BoxGroup& b, const BoxGroup& c, const BoxGroup& d, const Widths& world) {
  double p = a.share * b.share;
  for (std::size_t k = 0; k < 3; ++k) p *= chance(std::max(c.side[k], d.side[k]), world[k]);
  return p;
}

float largest_coordinate(const Box& b) {
  float most = 0.0F;
  for (int axis = 0; axis < 3; ++axis) most = std::max({most, std::abs(b.min[axis]), std::abs(b.max[axis])});
  return most;
}

float longest_side(const Box& b) {
  return std::max({b.max.x - b.min.x, b.max.y - b.min.y, b.max.z - b.min.z});
}

float quantile(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

PassMap map_of_shapes(const std::vector<Box>& sample, float largest_m) {
  std::vector<float> places;
  std::vector<float> sides;
  for (const Box& b : sample) {
    places.push_back(largest_coordinate(b));
    sides.push_back(longest_side(b));
    largest_m = std::max(largest_m, places.back());
  }
  PassMap map;
  if (quantile(places, 0.5) > largest_m / kFarWider) return map;
  // Distances from 0 that are shorter than nearly all boxes need not be distinguished.
  const auto zero = std::bit_cast<std::int32_t>(std::abs(quantile(sides, 0.05)));
  for (AxisMap& axis : map.axis) axis = {true, zero, 1.0F};
  return map;
}

// The power of two that scales a side to about 1.
float scale_for(double side, double width) {
  const double cell = std::max(side, width / kMostCells);
  if (!(cell > 0.0)) return 1.0F;
  return static_cast<float>(std::ldexp(1.0, std::clamp(-std::ilogb(cell), -100, 100)));
}

// Whether so many boxes overlap that writing the pairs takes most of the time; each pass would write pairs of its own.
// 127 * 64 pairs are tested, so a hundredth of them is some 80 hits.
bool is_crowded(const std::vector<Box>& sample) {
  constexpr std::size_t kLookedAt = 128;
  const std::size_t stride = std::max<std::size_t>(1, sample.size() / kLookedAt);
  std::size_t hits = 0;
  std::size_t tests = 0;
  for (std::size_t i = 0; i < sample.size(); i += stride)
    for (std::size_t j = i + stride; j < sample.size(); j += stride, ++tests)
      hits += overlaps(sample[i], sample[j]) ? 1 : 0;
  return 100 * hits > tests;
}

// Statistics of the sample, in the coordinates of the map, for each set of long axes (core::long_axes).
struct Kinds {
  std::array<BoxGroup, 8> kind;
  Widths world{};
};

Kinds kinds_of(const std::vector<Box>& sample, const PassMap& map) {
  Kinds kinds;
  Box bounds = empty_box();
  for (const Box& given : sample) {
    const Box b = map(given);
    bounds = grown(grown(bounds, b.min), b.max);
    BoxGroup& kind = kinds.kind[long_axes(b)];
    kind.share += 1.0;
    for (int k = 0; k < 3; ++k)
      kind.side[static_cast<std::size_t>(k)] += static_cast<double>(b.max[k]) - static_cast<double>(b.min[k]);
  }
  for (int k = 0; k < 3; ++k)
    kinds.world[static_cast<std::size_t>(k)] = static_cast<double>(bounds.max[k]) - static_cast<double>(bounds.min[k]);
  return kinds;
}

// The most frequent kinds become groups, at most `most` of them; the other kinds join the last group.
std::vector<BoxGroup> groups_of(const Kinds& kinds, std::uint32_t most, double boxes_a_sample, PassPlan& plan) {
  std::array<std::uint8_t, 8> by_share{0, 1, 2, 3, 4, 5, 6, 7};
  std::stable_sort(by_share.begin(), by_share.end(),
                   [&](std::uint8_t a, std::uint8_t b) { return kinds.kind[a].share > kinds.kind[b].share; });
  std::vector<BoxGroup> groups;
  for (const std::uint8_t which : by_share) {
    const BoxGroup& kind = kinds.kind[which];
    if (kind.share > 0.0 && groups.size() < most) groups.emplace_back();
    plan.group_of[which] = static_cast<std::uint8_t>(groups.size() - 1);
    groups.back().share += kind.share;
    for (std::size_t k = 0; k < 3; ++k) groups.back().side[k] += kind.side[k];
  }
  for (BoxGroup& g : groups) {
    for (double& side : g.side) side /= g.share;
    g.share *= boxes_a_sample;
  }
  return groups;
}

// Scales the axes to the sides of two groups, and puts the axis with the most cells first.
void fit_map(PassMap& map, const BoxGroup& a, const BoxGroup& b, const Widths& world) {
  Widths cells{};
  for (std::size_t k = 0; k < 3; ++k) {
    map.axis[k].scale *= scale_for(std::max(a.side[k], b.side[k]), world[k]);
    cells[k] = world[k] * static_cast<double>(map.axis[k].scale);
  }
  std::stable_sort(std::begin(map.from), std::end(map.from),
                   [&](std::uint8_t p, std::uint8_t q) { return cells[p] > cells[q]; });
}

// Adds a pass for every two groups, or for the only one.
void add_passes(const std::vector<BoxGroup>& groups, const Widths& world, PassPlan& plan) {
  std::array<double, kMostGroups> own_tests;
  own_tests.fill(INFINITY);
  std::array<std::size_t, kMostGroups> owner{};
  const auto count = static_cast<std::uint32_t>(groups.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a; b < count; ++b) {
      plan.plain_tests += cubic(groups[a], groups[b], world) * (a == b ? 0.5 : 1.0);
      if (a == b && count > 1) continue;
      BoxPass pass{1U << a | 1U << b, 0, plan.shapes};
      fit_map(pass.map, groups[a], groups[b], world);
      for (std::uint32_t g = a; g <= b; g += std::max(b - a, 1U)) {
        const double own = 0.5 * fitted(groups[g], groups[g], groups[a], groups[b], world);
        plan.pass_tests += kTestsOfABox * groups[g].share + own;
        if (own < own_tests[g]) own_tests[g] = own, owner[g] = plan.passes.size();
      }
      if (a != b) plan.pass_tests += fitted(groups[a], groups[b], groups[a], groups[b], world);
      plan.passes.push_back(pass);
    }
  for (std::uint32_t g = 0; g < count; ++g) plan.passes[owner[g]].owned |= 1U << g;
}

}  // namespace

PassPlan plan_passes(std::span<const Box> boxes, float largest_m, std::uint32_t least_boxes) {
  const auto n = static_cast<std::uint32_t>(boxes.size());
  std::vector<Box> sample;
  for (const std::uint32_t k : boxes_to_plan_by(n, least_boxes)) {
    const Box& b = boxes[k];
    // The search itself refuses invalid boxes.
    if (!(b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z && std::isfinite(largest_coordinate(b))))
      return {};
    sample.push_back(b);
  }
  return plan_passes_by_sample(sample, n, largest_m);
}

std::vector<std::uint32_t> boxes_to_plan_by(std::uint32_t count, std::uint32_t least_boxes) {
  std::vector<std::uint32_t> which;
  if (count < std::max(least_boxes, 2U)) return which;
  const std::uint32_t stride = (count + kSampled - 1) / kSampled;
  for (std::uint32_t k = 0; k < count; k += stride) which.push_back(k);
  return which;
}

PassPlan plan_passes_by_sample(const std::vector<Box>& sample, std::uint32_t n, float largest_m) {
  if (sample.empty()) return {};
  const PassMap shapes = map_of_shapes(sample, largest_m);
  const Kinds kinds = kinds_of(sample, shapes);
  const double boxes_a_sample = static_cast<double>(n) / static_cast<double>(sample.size());
  PassPlan plan;
  plan.shapes = shapes;
  plan.plain_tests = kTestsOfABox * n;
  // In logarithmic coordinates, sides differ by powers of two within every kind, and the levels of one octree separate
  // them.
  const std::uint32_t most_groups = plan.is_logarithmic() ? 1U : kMostGroups;
  add_passes(groups_of(kinds, most_groups, boxes_a_sample, plan), kinds.world, plan);
  // The model does not know of clusters, so a world that is far wider than most positions in it is mapped whatever it
  // says.
  const bool is_gain = plan.is_logarithmic() || plan.plain_tests > kLeastGain * plan.pass_tests;
  if (!is_gain || is_crowded(sample)) plan.passes.clear();
  return plan;
}

std::string words_of(const PassPlan& plan) {
  if (plan.is_plain()) return "one search of the boxes as they are";
  char text[200];
  if (plan.is_logarithmic())
    std::snprintf(text, sizeof text, "one pass by exponent, since most places are below 2^-16 of the farthest");
  else
    std::snprintf(text, sizeof text, "%zu %s of long thin boxes: some %.2g tests are expected, %.2g without",
                  plan.passes.size(), plan.passes.size() == 1 ? "pass" : "passes", plan.pass_tests, plan.plain_tests);
  return text;
}

}  // namespace broadside::core
