// Cells of near vertices: whatever the place and the rounding, the nearest vertex is in the list of the cell in which
// the point lies.
#include "gpu/scene/near_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "core/method/proximity.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

struct Specimen {
  ShapeTrees trees;
  ShapeCells cells;
  NearNeeds needs;
};

// `finest`: the ratio of this shape's theta to the theta of the scene's finest shape.
Specimen specimen(std::uint32_t rings, float edges_in_theta, float range_m, float finest = 1.0F) {
  const std::vector<core::Vec3> vertices = bumpy_sphere(rings, 0.5F)->vertices;
  std::vector<std::uint32_t> indices(vertices.size());
  for (std::uint32_t k = 0; k < indices.size(); ++k) indices[k] = k;
  const float edge_m = 1.6F / static_cast<float>(rings);
  Specimen s;
  append_tree(s.trees, vertices, indices, edge_m);
  const float theta_m = edges_in_theta * edge_m;
  s.needs = {theta_m, theta_m / finest, 0.6F, range_m};
  append_cells(s.cells, s.trees, s.needs);
  quantize_vertices(s.cells, s.trees);
  return s;
}

// The cell in which a vertex of another body lies, as device code finds it: the vertex and the other body's position
// are rounded separately.
std::size_t cell_of(const NearCells& cells, core::Vec3 vertex, core::Vec3 other_from_this) {
  const core::Vec3 origin = cells.quanta_per_m * (other_from_this - cells.low);
  const std::uint32_t count[] = {cells.count_x, cells.count_y, cells.count_z};
  std::size_t at[3];
  for (int k = 0; k < 3; ++k) {
    const int sum = static_cast<int>(std::floor(static_cast<double>(vertex[k]) * cells.quanta_per_m)) +
                    static_cast<int>(std::floor(origin[k])) + 1;
    at[k] = static_cast<std::size_t>(std::clamp(sum, 0, static_cast<int>(count[k] << cells.shift) - 1)) >> cells.shift;
  }
  return cell_index(static_cast<std::uint32_t>(at[0]), static_cast<std::uint32_t>(at[1]),
                    static_cast<std::uint32_t>(at[2]), cells.stride_y, cells.stride_z);
}

// Compares all vertices with the list, for a vertex of another body and a place of this one that are both up to range_m
// from the origin.
void compare_with_all(const Specimen& s, std::uint64_t seed, float range_m) {
  const NearCells& cells = s.cells.headers.front();
  Dice dice(seed);
  int near = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    const core::Vec3 place = dice.cube(1.98F * range_m);
    const core::Vec3 vertex = dice.cube(0.4F);
    const core::Vec3 other_place = place + dice.cube(1.4F) - vertex;
    const core::Vec3 world = vertex + other_place;
    core::Proximity all;
    for (std::uint32_t k = 0; k < s.trees.vertices.size(); ++k) {
      const PackedVec3& v = s.trees.vertices[k];
      if (!std::isfinite(v.v.x)) continue;
      const core::Proximity found{core::squared_distance(world, v.v + place), 0, std::bit_cast<std::uint32_t>(v.w)};
      if (found.squared_distance_m2 < s.needs.theta_m * s.needs.theta_m && core::is_nearer(found, all)) all = found;
    }
    core::Proximity listed;
    const std::size_t cell = cell_of(cells, vertex, other_place - place);
    const std::uint8_t lower = s.cells.lower[cells.first_lower + cell];
    const float lower_m = static_cast<float>(lower) * cells.lower_step_m;
    const NearList list = unpacked_list(s.cells.lists[cells.first_list + cell]);
    EXPECT_EQ(lower == kNothingNear, list.length == 0);
    for (std::uint32_t k = 0; k < 4 * list.length; ++k) {
      const NearEntry& entry = s.cells.entries[cells.first_entry + list.begin + k / 4];
      const PackedVec3& v = s.trees.vertices[entry.vertex[k % 4]];
      const core::Proximity found{core::squared_distance(world, v.v + place), 0, std::bit_cast<std::uint32_t>(v.w)};
      EXPECT_LE(lower_m * lower_m, found.squared_distance_m2);
      if (found.squared_distance_m2 < s.needs.theta_m * s.needs.theta_m && core::is_nearer(found, listed))
        listed = found;
    }
    ASSERT_EQ(listed, all) << "turn " << turn;
    near += all.is_touching() ? 1 : 0;
  }
  EXPECT_GT(near, 100);
}

TEST(NearCells, HoldTheNearestVertexOfEveryPoint) {
  for (const float edges_in_theta : {0.5F, 1.0F, 3.0F}) {
    SCOPED_TRACE(edges_in_theta);
    const Specimen s = specimen(16, edges_in_theta, 20.0F);
    ASSERT_GT(s.cells.headers.front().count_x, 0U);
    compare_with_all(s, 1, 1.0F);
    compare_with_all(s, 2, 19.0F);
  }
}

// Beside a finer shape: quanta are those of the finer shape, and a cell spans as many of them as keep it no larger than
// half of theta.
TEST(NearCells, HaveTheQuantaOfTheFinestShape) {
  for (const float finest : {1.2F, 2.0F, 3.0F}) {
    SCOPED_TRACE(finest);
    const Specimen s = specimen(16, 1.0F, 20.0F, finest);
    const NearCells& cells = s.cells.headers.front();
    ASSERT_GT(cells.count_x, 0U);
    const std::uint32_t alone = specimen(16, 1.0F / finest, 20.0F).cells.headers.front().shift;
    EXPECT_EQ(cells.shift, alone + (finest < 2.0F ? 0 : 1));
    compare_with_all(s, 4, 5.0F);
  }
}

// The entries that fill up the last leaf repeat the place of a vertex, so that no lookup is outside the cells.
TEST(NearCells, QuantizeEveryVertex) {
  const Specimen s = specimen(9, 1.0F, 20.0F);
  const NearCells& cells = s.cells.headers.front();
  ASSERT_EQ(s.cells.quantized.size(), s.trees.vertices.size());
  ASSERT_GT(cells.count_x, 0U);
  for (std::size_t k = 0; k < s.cells.quantized.size(); ++k) {
    const QuantizedVertex& q = s.cells.quantized[k];
    const core::Vec3 v = cells.quanta_per_m * s.trees.vertices[k].v;
    if (!std::isfinite(v.x)) continue;
    for (const auto& [exact, rounded] : {std::pair{v.x, q.x}, std::pair{v.y, q.y}, std::pair{v.z, q.z}}) {
      EXPECT_NEAR(exact, rounded + 0.5F, 0.51F);
      EXPECT_LT(std::abs(rounded), cells.reach);
    }
  }
}

// No two cells share a place.
TEST(NearCells, BricksHoldEveryCellOnce) {
  const Specimen s = specimen(16, 1.0F, 20.0F);
  const NearCells& cells = s.cells.headers.front();
  std::vector<std::uint8_t> met(s.cells.lower.size(), 0);
  for (std::uint32_t z = 0; z < cells.count_z; ++z)
    for (std::uint32_t y = 0; y < cells.count_y; ++y)
      for (std::uint32_t x = 0; x < cells.count_x; ++x) ++met.at(cell_index(x, y, z, cells.stride_y, cells.stride_z));
  EXPECT_EQ(std::ranges::max(met), 1);
  EXPECT_EQ(std::ranges::count(met, 1), std::ptrdiff_t{cells.count_x} * cells.count_y * cells.count_z);
}

// Far from the origin, vertices at one place may be rounded to different ones: lists that allow for it are longer.
TEST(NearCells, AllowForRoundingFarFromTheOrigin) {
  const Specimen s = specimen(16, 1.0F, 50000.0F);
  ASSERT_GT(s.cells.headers.front().count_x, 0U);
  compare_with_all(s, 3, 49000.0F);
  EXPECT_GT(s.cells.entries.size(), specimen(16, 1.0F, 20.0F).cells.entries.size());
}

TEST(NearCells, AreLeftOutWhereTheyDoNotPay) {
  EXPECT_EQ(specimen(4, 1.0F, 20.0F).cells.headers.front().count_x, 0U) << "a few vertices";
  EXPECT_EQ(specimen(80, 1.0F, 20.0F).cells.headers.front().count_x, 0U) << "very many";
  EXPECT_EQ(specimen(16, 9.0F, 20.0F).cells.headers.front().count_x, 0U) << "lists of hundreds";
}

// Several shapes share the arrays.
TEST(NearCells, OfASecondShapeFollowTheFirstOnes) {
  Specimen s = specimen(16, 1.0F, 20.0F);
  const Specimen alone = s;
  append_no_cells(s.cells);
  append_cells(s.cells, s.trees, s.needs);
  ASSERT_EQ(s.cells.headers.size(), 3U);
  EXPECT_EQ(s.cells.headers[1].count_x, 0U);
  EXPECT_EQ(s.cells.headers[2].first_entry, alone.cells.entries.size());
  EXPECT_EQ(s.cells.entries.size(), 2 * alone.cells.entries.size());
  EXPECT_TRUE(std::equal(alone.cells.lists.begin(), alone.cells.lists.end(),
                         s.cells.lists.begin() + s.cells.headers[2].first_list));
}

}  // namespace
}  // namespace broadside::gpu
