// What the GPU's engines count of their work. Tests on the host and on a GPU use the same figures.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/dynamics.hpp"
#include "core/engine/work_counting.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {

using tests::Counts;
using tests::counts_of;

// Counts of so many frames. The subject must offer counting.
inline Counts counts_of(core::Dynamics& subject, const core::Scene& scene, int frames) {
  dynamic_cast<core::CountsWork&>(subject).count_work();
  EXPECT_TRUE(subject.load(scene).ok());
  for (int k = 0; k < frames; ++k) EXPECT_TRUE(subject.step(scene.dt_s).ok());
  return counts_of(subject);
}

inline Counts counts_of(core::BroadPhase& subject, const std::vector<core::Box>& boxes) {
  dynamic_cast<core::CountsWork&>(subject).count_work();
  EXPECT_TRUE(subject.load(boxes, std::vector<std::uint8_t>(boxes.size())).ok());
  EXPECT_TRUE(subject.find().ok());
  return counts_of(subject);
}

// Work of three frames of 40 thrown spheres, and of 2500 boxes. Each figure was counted on the host; other tests check
// the host's counts against closed forms. A GPU has to count the same.
struct WorkRow {
  std::string_view broad;   // as the setting; "hash" = hash-gpu
  std::string_view levels;  // of dynamics; empty: the broad phase alone is counted
  std::uint64_t broad_tests, broad_nodes, level_tests;
};

inline core::Scene counted_scene() {
  SceneShape shape;
  shape.bodies = 40;
  shape.cube_m = 2.5F;
  return thrown({bumpy_sphere(4, 0.5F), bumpy_sphere(3, 0.6F)}, shape);
}

inline std::vector<core::Box> counted_boxes(int count = 2500, float cube_m = 12.0F) {
  std::vector<core::Box> boxes;
  Dice dice(11);
  for (int i = 0; i < count; ++i) {
    const core::Vec3 center = dice.cube(cube_m);
    const core::Vec3 half{0.05F + 0.2F * dice.next(), 0.05F + 0.2F * dice.next(), 0.05F + 0.2F * dice.next()};
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

// Of 2500 boxes by the search among many, which engines choose where there are more; and of so many.
constexpr std::uint64_t kBulkTests = 26873;
constexpr std::uint64_t kBulkNodes = 7871;
inline std::vector<core::Box> bulk_counted_boxes() {
  return counted_boxes(60'000, 34.0F);
}
constexpr std::uint64_t kTestsOfMore = 354680;
constexpr std::uint64_t kNodesOfMore = 189714;

constexpr std::uint64_t kNotCounted = ~std::uint64_t{0};

inline void expect_row(const WorkRow& row, const Counts& counts) {
  const auto expect = [&](std::string_view name, std::uint64_t expected) {
    const auto found = counts.find(name);
    EXPECT_EQ(found == counts.end() ? kNotCounted : found->second, expected)
        << name << ", broad " << row.broad << ", levels " << row.levels;
  };
  expect("broad: box tests", row.broad_tests);
  expect("broad: nodes visited", row.broad_nodes);
  expect("level stage: box tests", row.level_tests);
}

inline constexpr std::array<WorkRow, 10> kWorkRows{{
    {"tree", "C", 2340, kNotCounted, 171584},
    {"octree", "C", 2340, kNotCounted, 171584},
    {"hash", "C", 1144, 17622, 171584},
    {"tree", "flat", 2340, kNotCounted, kNotCounted},
    {"brute", "A", kNotCounted, kNotCounted, 1083102},
    {"brute", "B", kNotCounted, kNotCounted, 264192},
    {"brute", "level1", kNotCounted, kNotCounted, 149760},
    {"tree", "", 23753, 8770, kNotCounted},
    {"octree", "", 711590, kNotCounted, kNotCounted},
    {"hash", "", 1018, 26282, kNotCounted},
}};

}  // namespace broadside::gpu
