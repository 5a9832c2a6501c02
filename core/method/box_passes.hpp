// Passes of a broad phase over sets for which one octree of cubic cells is slow: boxes that are long and thin, and
// worlds in which positions differ by many powers of two.
//
// A pass searches some of the boxes in mapped coordinates, with one map for each axis. Any monotone map keeps every
// overlap: from a.min <= b.max follows f(a.min) <= f(b.max), however f rounds. So the pairs of the mapped boxes include
// all pairs of the given ones, each is then tested on the boxes as given, and exactness depends on no formula here. The
// purpose of the map: in its coordinates the boxes of the pass are about as long on each axis, so a cubic cell holds
// few, and scales that differ by powers of two lie side by side.
//
// Boxes are grouped by the axes on which they are long. There is a pass for every two groups. Several passes find a
// pair of boxes of one group, and only the pass that owns the group keeps it.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::core {

// The map of one axis; it is monotone.
struct AxisMap {
  bool is_logarithmic = false;
  std::int32_t zero_bits = 0;  // of a logarithmic map: magnitudes with smaller bits become 0
  float scale = 1.0F;          // a power of two

  // Finite for a finite coordinate. Logarithmic: the bits of a float, read as an integer, grow with its magnitude, by
  // 2^23 for each power of two.
  [[nodiscard]] float operator()(float v) const {
    // Far above every coordinate that a plan produces (2^31), and small enough that a sum of two does not overflow.
    constexpr float kMost = 0x1p120F;
    if (!is_logarithmic) {
      const float w = v * scale;
      return w < -kMost ? -kMost : w > kMost ? kMost : w;
    }
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const std::int32_t above = static_cast<std::int32_t>(bits & 0x7FFFFFFFU) - zero_bits;
    const std::int32_t magnitude = above > 0 ? above : 0;
    return static_cast<float>((bits >> 31U) != 0 ? -magnitude : magnitude) * scale;
  }
};

struct PassMap {
  AxisMap axis[3];
  // Which axis of the given boxes becomes x, y and z: the one with the most cells becomes x, along which a GPU's table
  // has its runs.
  std::uint8_t from[3] = {0, 1, 2};

  [[nodiscard]] Box operator()(const Box& b) const {
    Box mapped;
    for (int k = 0; k < 3; ++k) {
      mapped.min[k] = axis[from[k]](b.min[from[k]]);
      mapped.max[k] = axis[from[k]](b.max[from[k]]);
    }
    return mapped;
  }
};

inline constexpr std::uint32_t kMostGroups = 4;

struct BoxPass {
  std::uint32_t members = 1;  // bit g: group g takes part
  std::uint32_t owned = 1;    // bit g: pairs within group g are kept here
  PassMap map;

  [[nodiscard]] bool has(std::uint32_t group) const { return (members >> group & 1U) != 0; }
  [[nodiscard]] bool keeps(std::uint32_t group_a, std::uint32_t group_b) const {
    return group_a != group_b || (owned >> group_a & 1U) != 0;
  }
};

// One bit for each axis on which a box is at least a sixteenth as long as on its longest.
inline constexpr float kThinBox = 0x1p-4F;
inline std::uint32_t long_axes(const Box& b) {
  const float x = b.max.x - b.min.x;
  const float y = b.max.y - b.min.y;
  const float z = b.max.z - b.min.z;
  const float xy = x < y ? y : x;
  const float least = kThinBox * (xy < z ? z : xy);
  return (x >= least ? 1U : 0U) | (y >= least ? 2U : 0U) | (z >= least ? 4U : 0U);
}

struct PassPlan {
  std::vector<BoxPass> passes;  // empty: one search of the boxes as they are is best
  PassMap shapes;               // the coordinates in which a box's long axes select its group
  std::uint8_t group_of[8] = {};
  // Expected tests of pairs, from the model of box_passes.cpp.
  double plain_tests = 0.0;
  double pass_tests = 0.0;

  [[nodiscard]] bool is_plain() const { return passes.empty(); }
  [[nodiscard]] bool is_logarithmic() const { return shapes.axis[0].is_logarithmic; }
  [[nodiscard]] std::uint32_t group(const Box& b) const { return group_of[long_axes(shapes(b))]; }
};

// A search of fewer boxes takes some tens of microseconds, whatever the boxes are.
inline constexpr std::uint32_t kLeastBoxesForPasses = 4096;

// Computed from a fixed sample of the boxes: the same boxes give the same plan. `largest_m`: the largest magnitude of a
// coordinate, where it is known; otherwise 0.
PassPlan plan_passes(std::span<const Box> boxes, float largest_m = 0.0F,
                     std::uint32_t least_boxes = kLeastBoxesForPasses);

// The same in two steps, where the boxes are elsewhere: which boxes the plan needs, and the plan from them. They must
// be valid.
std::vector<std::uint32_t> boxes_to_plan_by(std::uint32_t count, std::uint32_t least_boxes = kLeastBoxesForPasses);
PassPlan plan_passes_by_sample(const std::vector<Box>& sample, std::uint32_t count, float largest_m = 0.0F);

// "one search of the boxes as they are", or the passes and why.
std::string words_of(const PassPlan& plan);

}  // namespace broadside::core
