// The lanes of a warp give the results of a single lane: loop by loop, and for contacts of hulls and meshes bit by bit.
#include "gpu/stages/rigid/warp_lanes.cuh"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "core/method/rigid/make_manifolds.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"
#include "tests/core/method/rigid/mesh_cases.hpp"

namespace broadside::gpu {
namespace {

using core::OneLane;

// work() by all lanes of a warp.
template <typename Work>
void by_warp(const Work& work) {
  on_host::run(on_host::kOneWarp, 0, [&](unsigned char*) { work(); });
}

constexpr int kCounts[] = {0, 1, 5, 31, 32, 33, 64, 100};

TEST(WarpLanes, FindTheFirstOfTheLeast) {
  std::mt19937 random(1);
  for (const int count : kCounts) {
    std::vector<float> values(static_cast<std::size_t>(count));
    for (float& v : values) v = static_cast<float>(random() % 7);  // many are alike
    const auto value = [&](int k) { return values[static_cast<std::size_t>(k)]; };
    const core::FirstLeast one = OneLane::first_least(count, value);
    by_warp([&] {
      const core::FirstLeast own = WarpLanes::first_least(count, value);
      EXPECT_EQ(own.item, one.item) << count;
      EXPECT_EQ(own.value, one.value) << count;
    });
  }
}

TEST(WarpLanes, FindTheFirstOfTheBest) {
  std::mt19937 random(2);
  for (const int count : kCounts) {
    std::vector<core::Rated> rated(static_cast<std::size_t>(count));
    for (core::Rated& r : rated)
      r = {random() % 3 != 0, static_cast<float>(random() % 4), static_cast<std::uint32_t>(random() % 3)};
    for (const bool counts_any : {true, false}) {
      const auto rate = [&](int k) { return counts_any ? rated[static_cast<std::size_t>(k)] : core::Rated{}; };
      const int one = OneLane::first_best(count, rate);
      by_warp([&] { EXPECT_EQ(WarpLanes::first_best(count, rate), one) << count; });
    }
  }
}

TEST(WarpLanes, VisitInOrderThoughVisitsChangeWhatIsVisited) {
  std::mt19937 random(3);
  for (const int count : kCounts) {
    std::vector<unsigned> values(static_cast<std::size_t>(count));
    for (unsigned& v : values) v = random() % 100;
    const auto visited_by = [&](auto lanes) {
      std::vector<int> visited;
      unsigned most = 0;
      // The items that are larger than all before them.
      const auto is_above = [&](int k) { return values[static_cast<std::size_t>(k)] >= most; };
      decltype(lanes)::each_in_turn(count, is_above, [&](int k) {
        visited.push_back(k);
        most = values[static_cast<std::size_t>(k)] + 1;
      });
      decltype(lanes)::each_with(
          count, [&](int k) { return values[static_cast<std::size_t>(k)] % 3 == 0; },
          [&](int k) { visited.push_back(k); });
      visited.push_back(decltype(lanes)::count_of(count, [&](int k) { return k % 5 == 0; }));
      return visited;
    };
    const std::vector<int> one = visited_by(OneLane{});
    by_warp([&] { EXPECT_EQ(visited_by(WarpLanes{}), one) << count; });
  }
}

TEST(WarpLanes, TakeHandfulsAlike) {
  std::mt19937 random(4);
  for (const unsigned one_in : {1U, 2U, 9U}) {
    std::vector<char> is_made(300);
    for (char& m : is_made) m = random() % one_in == 0 ? 1 : 0;
    const auto taken_by = [&](auto lanes) {
      std::vector<int> taken;
      typename decltype(lanes)::template Handful<int> some;
      for (int from = 0; from < 300;) {
        from = some.fill(from, 300, [&](int k, int& item) {
          item = k;
          return is_made[static_cast<std::size_t>(k)] != 0;
        });
        taken.push_back(-some.count);
        int last = -1;
        // Multiples of 3 that are more than 6 above the last.
        some.each_in_turn([&](int item) { return item % 3 == 0 && (last < 0 || item > last + 6); },
                          [&](int item) { taken.push_back(last = item); });
      }
      const auto has = [&](int k) { return is_made[static_cast<std::size_t>(k)] != 0; };
      const auto make = [](int k) { return 1000 + k; };
      for (int from = 0; from < 300;) {
        from = some.fill_with(from, 300, has, make);
        some.each_in_turn([](int) { return true; }, [&](int item) { taken.push_back(item); });
      }
      decltype(lanes)::template each_made<int>(300, has, make, [&](int item) { taken.push_back(item); });
      return taken;
    };
    const std::vector<int> one = taken_by(OneLane{});
    by_warp([&] { EXPECT_EQ(taken_by(WarpLanes{}), one) << one_in; });
  }
}

// A tree over numbers: node n has the children 2 n and 2 n + 1.
TEST(WarpLanes, WalkTreesInTheSameOrder) {
  struct Found {
    int count = 0;
    std::uint32_t node = 0;
    int item = 0;
  };
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const auto walked_by = [&](auto lanes) {
      using Lanes = decltype(lanes);
      std::vector<std::uint32_t> walked;
      const auto hash = [&](std::uint32_t n) { return (n + seed) * 2654435761U >> 16; };
      Lanes::walk(
          [&](core::NodePair pair, core::NodePair(&below)[2]) {
            if (hash(pair.a) % 8 == 0 && pair.a > 3) return 0;
            if (pair.a >= 2000) return Lanes::kLeaf;
            below[0] = {2 * pair.a + 1, pair.b + 1};
            below[1] = {2 * pair.a + 2, pair.b + 2};
            return 2;
          },
          [&](core::NodePair pair) { return static_cast<int>(hash(pair.a) % 5); },
          [&](core::NodePair pair, int item) {
            return Found{static_cast<int>(pair.a % 3), pair.a, item};
          },
          [&](const Found& found) {
            walked.insert(walked.end(), {found.node, static_cast<std::uint32_t>(found.item)});
          });
      return walked;
    };
    const std::vector<std::uint32_t> one = walked_by(OneLane{});
    ASSERT_GT(one.size(), 1000U);
    by_warp([&] { EXPECT_EQ(walked_by(WarpLanes{}), one) << seed; });
  }
}

// Returns how many points there were.
int compare(const core::ContactShape& a, const core::ContactPose& at_a, const core::ContactShape& b,
            const core::ContactPose& at_b, float reach_m) {
  core::Manifold one[core::kPatchesOfPair];
  const int count = core::make_manifolds(a, at_a, b, at_b, reach_m, one);
  int points = 0;
  for (int k = 0; k < count; ++k) points += one[k].count;
  by_warp([&] {
    core::Manifold own[core::kPatchesOfPair];
    ASSERT_EQ(core::make_manifolds<WarpLanes>(a, at_a, b, at_b, reach_m, own), count);
    for (int k = 0; k < count; ++k) {
      EXPECT_EQ(std::memcmp(&own[k].normal, &one[k].normal, sizeof(core::Vec3)), 0);
      ASSERT_EQ(own[k].count, one[k].count);
      for (int p = 0; p < own[k].count; ++p)
        EXPECT_EQ(std::memcmp(&own[k].points[p], &one[k].points[p], sizeof(core::ManifoldPoint)), 0);
    }
  });
  return points;
}

TEST(WarpLanes, FindTheContactsOfHullsAndMeshes) {
  core::Draw draw(5);
  const core::Subject round = core::hull(core::random_hull(draw, 150));  // has many edges: other paths
  const core::Subject few = core::hull(core::random_hull(draw, 20));
  const core::Subject box = core::box({0.5F, 0.4F, 0.3F});
  const core::Subject capsule = core::capsule(0.2F, 0.5F, 1);
  const core::MeshBody mesh(core::random_hull(draw, 60), true);
  const core::ContactShape shapes[] = {round.shape,   few.shape,  box.shape,
                                       capsule.shape, mesh.shape, core::domain_face_shape(2)};
  int points = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const core::ContactShape& a = shapes[trial % 5];
    const core::ContactShape& b = shapes[trial / 5 % 6];
    const core::ContactPose at_a{draw.in_cube(0.6F), trial % 3 == 0 ? draw.quarter_turns() : draw.turn()};
    core::ContactPose at_b{draw.in_cube(0.6F), trial % 3 == 0 ? draw.quarter_turns() : draw.turn()};
    if (b.kind == core::ContactKind::kHalfSpace) at_b = {{0.0F, at_a.x.y - 0.6F, 0.0F}, {}};
    points += compare(a, at_a, b, at_b, trial % 2 == 0 ? 0.05F : 0.5F);
  }
  EXPECT_GT(points, 200);
}

}  // namespace
}  // namespace broadside::gpu
