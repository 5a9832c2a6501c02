// Cells of near vertices: whatever the place and the rounding, the nearest vertex is in the list of the point's cell.
#include "gpu/near_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
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

Specimen specimen(std::uint32_t rings, float edges_in_theta, float range_m) {
  const std::vector<core::Vec3> vertices = bumpy_sphere(rings, 0.5F)->vertices;
  std::vector<std::uint32_t> indices(vertices.size());
  for (std::uint32_t k = 0; k < indices.size(); ++k) indices[k] = k;
  const float edge_m = 1.6F / static_cast<float>(rings);
  Specimen s;
  append_tree(s.trees, vertices, indices, edge_m);
  s.needs = {edges_in_theta * edge_m, 0.6F, range_m};
  append_cells(s.cells, s.trees, s.needs);
  return s;
}

// The cell that a point in body coordinates lies in, as device code finds it; its index, or the number of cells.
std::size_t cell_of(const NearCells& cells, core::Vec3 p) {
  const core::Vec3 at = cells.cells_per_m * (p - cells.low);
  const std::uint32_t count[] = {cells.count_x, cells.count_y, cells.count_z};
  for (int k = 0; k < 3; ++k)
    if (!(at[k] >= 0.0F && at[k] < static_cast<float>(count[k]))) return std::size_t{count[0]} * count[1] * count[2];
  return (static_cast<std::size_t>(at.z) * count[1] + static_cast<std::size_t>(at.y)) * count[0] +
         static_cast<std::size_t>(at.x);
}

// A vertex of another body and a place of this one, both up to range_m from the origin: all vertices against the list.
void compare_with_all(const Specimen& s, std::uint64_t seed, float range_m) {
  const NearCells& cells = s.cells.headers.front();
  const std::size_t count = std::size_t{cells.count_x} * cells.count_y * cells.count_z;
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
    const std::size_t cell = cell_of(cells, vertex + (other_place - place));
    if (cell < count) {
      const std::uint8_t lower = s.cells.lower[cells.first_lower + cell];
      const float lower_m = static_cast<float>(lower) * cells.lower_step_m;
      const std::uint32_t* begin = &s.cells.begin[cells.first_begin + cell];
      EXPECT_EQ(lower == kNothingNear, begin[0] == begin[1]);
      for (std::uint32_t k = 2 * begin[0]; k < 2 * begin[1]; ++k) {
        const std::uint32_t word = s.cells.entries[cells.first_entry + k / 2];
        const PackedVec3& v = s.trees.vertices[k % 2 == 0 ? word & 0xFFFFU : word >> 16U];
        const core::Proximity found{core::squared_distance(world, v.v + place), 0, std::bit_cast<std::uint32_t>(v.w)};
        EXPECT_LE(lower_m * lower_m, found.squared_distance_m2);
        if (found.squared_distance_m2 < s.needs.theta_m * s.needs.theta_m && core::is_nearer(found, listed))
          listed = found;
      }
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

// Far from the origin vertices of one place round to others: lists that allow for it are longer.
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
  EXPECT_TRUE(std::equal(alone.cells.begin.begin(), alone.cells.begin.end(),
                         s.cells.begin.begin() + s.cells.headers[2].first_begin));
}

}  // namespace
}  // namespace broadside::gpu
