// The validators' nearest-vertex search against trying every pair of vertices.
#include "validation/vertex_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace broadside::tests {
namespace {

using core::Vec3;
using validation::Vec3d;
using validation::VertexTree;

std::vector<Vec3> cloud(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < count; ++k) points.push_back({place(random), place(random), place(random)});
  return points;
}

double least(const std::vector<Vec3>& a, Vec3d xa, const std::vector<Vec3>& b, Vec3d xb) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec3 p : a)
    for (const Vec3 q : b) {
      const double dx = (p.x + xa.x) - (q.x + xb.x);
      const double dy = (p.y + xa.y) - (q.y + xb.y);
      const double dz = (p.z + xa.z) - (q.z + xb.z);
      best = std::min(best, std::sqrt(dx * dx + dy * dy + dz * dz));
    }
  return best;
}

TEST(VertexTree, FindsTheNearestOfAll) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto a = cloud(1 + 13 * seed, seed);
    const auto b = cloud(400 - 11 * seed, 1000 + seed);
    const Vec3d xa{3.0, 0.1 * seed, 0.0};
    const Vec3d xb{3.0 + 0.1 * seed, 0.0, 1.0};
    const double expected = least(a, xa, b, xb);
    // The two orders of the same float64 additions differ by a few units of 2^-53 of coordinates below 8.
    EXPECT_NEAR(VertexTree(a).nearest(xa, VertexTree(b), xb, 100.0), expected, 16.0 * 0x1p-53 * 8.0);
    EXPECT_NEAR(VertexTree(b).nearest(xb, VertexTree(a), xa, 100.0), expected, 16.0 * 0x1p-53 * 8.0);
  }
}

TEST(VertexTree, VisitsAllThatAreNoFartherAway) {
  const auto a = cloud(60, 3);
  const auto b = cloud(90, 4);
  const Vec3d xa{0.5, 0.25, 0.0};
  const Vec3d xb{0.0, 0.0, 1.0};
  constexpr double kDistance = 0.75;
  // Pairs nearer to the bound than the two orders of addition differ may be on either side.
  constexpr double kEither = 16.0 * 0x1p-53 * 8.0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  VertexTree(a).visit_within(xa, VertexTree(b), xb, kDistance,
                             [&](std::uint32_t p, std::uint32_t q) { EXPECT_TRUE(seen.emplace(p, q).second); });
  std::size_t expected = 0;
  for (std::uint32_t p = 0; p < a.size(); ++p)
    for (std::uint32_t q = 0; q < b.size(); ++q) {
      const double distance = least({a[p]}, xa, {b[q]}, xb);
      if (std::abs(distance - kDistance) < kEither) continue;
      expected += distance < kDistance ? 1 : 0;
      EXPECT_EQ(seen.contains({p, q}), distance < kDistance) << p << " and " << q;
    }
  EXPECT_GT(expected, 10U);
  EXPECT_LT(expected, a.size() * b.size() / 2);
}

TEST(VertexTree, NothingBelowTheBoundGivesTheBound) {
  const std::vector<Vec3> point{{0, 0, 0}};
  const VertexTree tree(point);
  EXPECT_EQ(tree.nearest({0, 0, 0}, tree, {1, 0, 0}, 1.0), 1.0);
  EXPECT_EQ(tree.nearest({0, 0, 0}, tree, {1, 0, 0}, 0.5), 0.5);
  EXPECT_EQ(tree.nearest({0, 0, 0}, tree, {1, 0, 0}, 2.0), 1.0);
  EXPECT_EQ(tree.nearest({0, 0, 0}, VertexTree({}), {0, 0, 0}, 2.0), 2.0);
}

}  // namespace
}  // namespace broadside::tests
