// The search of a pair's nearest vertices by several warps: against all vertices, and when it is told to end.
#include "gpu/stages/tree_search.cuh"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/method/proximity.hpp"
#include "gpu/shape_tree.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

TEST(TeamCounts, GoOnWhileSomethingIsLeftAndNobodySaysThatItIsOver) {
  EXPECT_FALSE((TeamCounts{0, 0}.goes_on()));
  EXPECT_TRUE((TeamCounts{1, 0}.goes_on()));
  EXPECT_TRUE((TeamCounts{0, 1}.goes_on()));
  EXPECT_FALSE((TeamCounts{TeamCounts::kOver, 0}.goes_on()));
  EXPECT_FALSE((TeamCounts{7 | TeamCounts::kOver, 9}.goes_on()));
  EXPECT_EQ(TeamCounts::place(7), 7U);
  EXPECT_EQ(TeamCounts::place(7 | TeamCounts::kOver), 7U);
}

// Two bumpy spheres in each other, searched by one block of two warps.
class TwoBodies {
 public:
  TwoBodies() {
    const std::vector<core::Vec3> vertices = bumpy_sphere(20, 0.5F)->vertices;
    std::vector<std::uint32_t> indices(vertices.size());
    std::iota(indices.begin(), indices.end(), 0U);
    append_tree(trees_, vertices, indices, kThetaM);
    view_.body_count = 2;
    view_.shapes.count = 1;
    view_.shapes.trees = trees_.headers.data();
    view_.shapes.tree_nodes = trees_.nodes.data();
    view_.shapes.tree_vertices = trees_.vertices.data();
    view_.detected.position = positions_;
  }

  core::Proximity nearest_of_all() const {
    core::Proximity nearest;
    for (const PackedVec3& a : trees_.vertices) {
      for (const PackedVec3& b : trees_.vertices) {
        const float d2 = core::squared_distance(a.v + positions_[0].v, b.v + positions_[1].v);
        const core::Proximity found{d2, std::bit_cast<std::uint32_t>(a.w), std::bit_cast<std::uint32_t>(b.w)};
        if (d2 < kThetaM * kThetaM && core::is_nearer(found, nearest)) nearest = found;
      }
    }
    return nearest;
  }

  // Told that it is over from the `over_at`-th time on that somebody asks. The stack has guards behind it.
  core::Proximity search(std::uint32_t over_at) {
    asked_ = 0;
    constexpr std::uint32_t kMembers = 2;
    constexpr std::uint32_t kGuard = 0xA5A5A5A5U;
    const std::uint32_t entries = kMembers * stack_entries_of(trees_.headers[0].top + 1);
    std::vector<std::uint32_t> stack(4 * entries, kGuard);
    TeamCounts counts[2];
    std::uint32_t bound = std::bit_cast<std::uint32_t>(INFINITY);
    core::Proximity nearest;
    on_host::run({{1}, {32 * kMembers}, 0}, 0, [&](unsigned char*) {
      const WarpShare share{threadIdx.x / 32, kMembers};
      const SearchTeam team{share, 0, {stack.data(), entries, entries}, counts};
      const TreePair pair(view_, {trees_.headers.data(), nullptr}, {0, 1}, &bound);
      const core::Proximity own = nearest_by_trees(pair, team, [&](bool asks) {
        if (asks) ++asked_;
        return asks && asked_ >= over_at ? 1U : 0U;
      });
      if (core::is_nearer(own, nearest)) nearest = own;
    });
    for (std::size_t k = 3 * std::size_t{entries}; k < stack.size(); ++k) EXPECT_EQ(stack[k], kGuard) << k;
    return nearest;
  }
  std::uint32_t asked() const { return asked_; }

 private:
  static constexpr float kThetaM = 0.08F;

  ShapeTrees trees_;
  PackedVec3 positions_[2] = {{{0.1F, 0.0F, 0.0F}, 1.0F}, {{0.85F, 0.2F, -0.1F}, 1.0F}};
  FrameView view_;
  std::uint32_t asked_ = 0;
};

TEST(TreeSearch, OfATeamFindsTheNearestOfAll) {
  TwoBodies bodies;
  const core::Proximity nearest = bodies.search(1000000);
  EXPECT_TRUE(nearest.is_touching());
  EXPECT_EQ(nearest, bodies.nearest_of_all());
  EXPECT_GT(bodies.asked(), 8U) << "rounds";
}

// The round in which it is heard is the last one.
TEST(TreeSearch, OfATeamEndsWhenItIsOver) {
  TwoBodies bodies;
  bodies.search(1000000);
  const std::uint32_t rounds = bodies.asked();
  for (std::uint32_t over_at = 1; over_at + 1 < rounds; ++over_at) {
    bodies.search(over_at);
    EXPECT_EQ(bodies.asked(), over_at + 1);
  }
}

}  // namespace
}  // namespace broadside::gpu
