// The search for a pair's nearest vertices by several warps: against all vertices, and when the search is told to end
// early.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/method/proximity.hpp"
#include "gpu/scene/shape_tree.hpp"
#include "gpu/stages/vertices/tree_start.cuh"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

// Takes the leftover work when it is asked for the ends_at-th time.
struct Ending {
  std::uint32_t ends_at = 0;
  std::uint32_t asked = 0;

  static bool is_asked_after(std::uint32_t /*round*/) { return true; }
  bool hand_over(const SearchTeam& /*team*/, const TeamCounts& /*left*/, float /*limit*/) { return ++asked >= ends_at; }
};

using NodeWords = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// Two bumpy spheres in each other, with this number of rings, searched by one block.
class TwoBodies {
 public:
  explicit TwoBodies(std::uint32_t members, std::uint32_t rings = 20, float theta_m = 0.08F)
      : TwoBodies(members, {rings, rings}, theta_m) {}
  TwoBodies(std::uint32_t members, std::pair<std::uint32_t, std::uint32_t> rings, float theta_m)
      : members_(members), theta_m_(theta_m) {
    append(bumpy_sphere(rings.first, 0.5F)->vertices);
    append(bumpy_sphere(rings.second, 0.5F)->vertices);
    view_.body_count = 2;
    view_.shapes.count = 2;
    view_.shapes.trees = trees_.headers.data();
    view_.shapes.tree_nodes = trees_.nodes.data();
    view_.shapes.tree_vertices = trees_.vertices.data();
    view_.detected.position = positions_;
  }

  core::Proximity nearest_of_all() const {
    core::Proximity nearest;
    for (const PackedVec3& a : vertices(0)) {
      for (const PackedVec3& b : vertices(1)) {
        const float d2 = core::squared_distance(a.v + positions_[0].v, b.v + positions_[1].v);
        const core::Proximity found{d2, std::bit_cast<std::uint32_t>(a.w), std::bit_cast<std::uint32_t>(b.w)};
        if (d2 < theta_m_ * theta_m_ && core::is_nearer(found, nearest)) nearest = found;
      }
    }
    return nearest;
  }

  // Ends at the `ends_at`-th time that it asks whether to hand over what is left.
  core::Proximity search(std::uint32_t ends_at) {
    asked_ = 0;
    core::Proximity nearest;
    in_block([&](const SearchTeam& team, const TreePair& pair) {
      Ending ending{ends_at};
      const core::Proximity own = nearest_by_trees(pair, team, TreeStart(pair, team).begin(), ending);
      if (threadIdx.x == 0) asked_ = ending.asked;
      if (core::is_nearer(own, nearest)) nearest = own;
    });
    return nearest;
  }

  // The entries of the stack when a search begins, as the words of their nodes.
  NodeWords start() {
    NodeWords found;
    in_block([&](const SearchTeam& team, const TreePair& pair) {
      const TeamCounts left = TreeStart(pair, team).begin();
      if (threadIdx.x != 0) return;
      EXPECT_EQ(left.leaves, 0U);
      for (std::uint32_t k = 0; k < left.nodes; ++k) found.emplace(team.at(left, k).a, team.at(left, k).b);
      EXPECT_EQ(found.size(), left.nodes) << "each once";
    });
    return found;
  }
  NodeWords near_upper_nodes() const {
    NodeWords near;
    for (const PackedBox& a : upper(0)) {
      for (const PackedBox& b : upper(1)) {
        const core::Box box_a = core::translated(unpack(a), positions_[0].v);
        const core::Box box_b = core::translated(unpack(b), positions_[1].v);
        if (squared_gap(box_a, box_b) < theta_m_ * theta_m_) near.emplace(a.low_tag, b.low_tag);
      }
    }
    return near;
  }
  NodeWords roots() const { return {{trees_.headers[0].root, trees_.headers[1].root}}; }
  std::uint32_t asked() const { return asked_; }

  std::uint32_t top(std::uint32_t body) const { return trees_.headers[body].top; }

 private:
  void append(const std::vector<core::Vec3>& vertices) {
    std::vector<std::uint32_t> indices(vertices.size());
    std::iota(indices.begin(), indices.end(), 0U);
    append_tree(trees_, vertices, indices, theta_m_);
  }
  std::span<const PackedVec3> vertices(std::uint32_t body) const {
    const TreeHeader& tree = trees_.headers[body];
    return std::span(trees_.vertices).subspan(tree.vertex_begin, std::size_t{tree.node_count[0]} * kLeafVertices);
  }
  std::span<const PackedBox> upper(std::uint32_t body) const {
    const TreeHeader& tree = trees_.headers[body];
    return std::span(trees_.upper).subspan(tree.upper_begin, tree.upper_count);
  }

  // Behind the stack lie guard words.
  template <typename Body>
  void in_block(const Body& body) {
    constexpr std::uint32_t kGuard = 0xA5A5A5A5U;
    const std::uint32_t entries = members_ * stack_entries_of(std::max(top(0), top(1)) + 1);
    std::vector<std::uint32_t> stack(4 * std::size_t{entries}, kGuard);
    TeamCounts counts[kTeamTurns] = {};
    std::uint32_t bound = std::bit_cast<std::uint32_t>(INFINITY);
    on_host::run({{1}, {32 * members_}, 0}, 0, [&](unsigned char*) {
      const WarpShare share{threadIdx.x / 32, members_};
      const SearchTeam team{share, 0, {stack.data(), entries, entries}, counts};
      body(team, TreePair(view_, {trees_.headers.data(), nullptr, trees_.upper.data(), nullptr},
                          {{positions_[0].v, 0}, {positions_[1].v, 1}}, &bound));
    });
    for (std::size_t k = 3 * std::size_t{entries}; k < stack.size(); ++k) EXPECT_EQ(stack[k], kGuard) << k;
  }

  std::uint32_t members_;  // warps
  float theta_m_;
  ShapeTrees trees_;
  PackedVec3 positions_[2] = {{{0.1F, 0.0F, 0.0F}, 1.0F}, {{0.85F, 0.2F, -0.1F}, 1.0F}};
  FrameView view_;
  std::uint32_t asked_ = 0;
};

TEST(TeamCounts, AreMuchWithFewNodesOrManyLeaves) {
  EXPECT_TRUE(is_much({4, 0}));
  EXPECT_FALSE(is_much({3, 15}));
  EXPECT_TRUE(is_much({3, 16}));
  EXPECT_FALSE(is_much({0, 63}));
  EXPECT_TRUE(is_much({0, 64}));
}

// With fewer warps than there are pairs of nodes below the roots, and with more.
class TreeSearch : public testing::TestWithParam<std::uint32_t> {};

TEST_P(TreeSearch, OfATeamFindsTheNearestOfAll) {
  TwoBodies bodies(GetParam());
  const core::Proximity nearest = bodies.search(1000000);
  EXPECT_TRUE(nearest.is_touching());
  EXPECT_EQ(nearest, bodies.nearest_of_all());
  EXPECT_GT(bodies.asked(), 0U) << "a long search";
}

// Down to a leaf that waits while the other tree is descended; and for two single leaves.
TEST_P(TreeSearch, OfTreesOfDifferentHeightsFindsTheNearestOfAll) {
  const std::pair<std::uint32_t, std::uint32_t> kRings[] = {{3, 66}, {66, 3}, {2, 20}, {20, 2}, {6, 40}, {2, 2}};
  std::set<std::pair<std::uint32_t, std::uint32_t>> tops;
  for (const auto& rings : kRings) {
    TwoBodies bodies(GetParam(), rings, 0.3F);
    tops.emplace(bodies.top(0), bodies.top(1));
    EXPECT_TRUE(bodies.nearest_of_all().is_touching()) << rings.first << " " << rings.second;
    EXPECT_EQ(bodies.search(1000000), bodies.nearest_of_all()) << rings.first << " " << rings.second;
  }
  EXPECT_TRUE(tops.contains({1, 4})) << "heights differ";
  EXPECT_TRUE(tops.contains({4, 1})) << "heights differ";
}

TEST_P(TreeSearch, BeginsAtAllUpperNodesNearEachOther) {
  TwoBodies bodies(GetParam());
  EXPECT_GT(bodies.near_upper_nodes().size(), 1U);
  EXPECT_EQ(bodies.start(), bodies.near_upper_nodes());
}

// A case in which every node is near every other.
TEST_P(TreeSearch, BeginsAtTheRootsWhereTheStackIsTooSmall) {
  TwoBodies bodies(GetParam(), 40, 5.0F);
  EXPECT_EQ(bodies.near_upper_nodes().size(), 2500U);
  const bool has_room = GetParam() == 16;
  EXPECT_EQ(bodies.start(), has_room ? bodies.near_upper_nodes() : bodies.roots());
  EXPECT_EQ(bodies.search(1000000), bodies.nearest_of_all());
}

TEST_P(TreeSearch, OfATeamEndsWhenWhatIsLeftIsHandedOver) {
  TwoBodies bodies(GetParam());
  bodies.search(1000000);
  const std::uint32_t times = bodies.asked();
  for (std::uint32_t ends_at = 1; ends_at < times; ++ends_at) {
    bodies.search(ends_at);
    EXPECT_EQ(bodies.asked(), ends_at);
  }
}

INSTANTIATE_TEST_SUITE_P(Warps, TreeSearch, testing::Values(2U, 4U, 16U));

}  // namespace
}  // namespace broadside::gpu
