// Which pairs of bodies meet, and how a warp descends the levels of a pair: against counting and against core/method.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

#include "core/method/levels.hpp"
#include "core/scene/body_octree.hpp"
#include "gpu/frame/divisor.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/stages/broad/body_ring.cuh"
#include "gpu/stages/levels/confirm_stage.cuh"

namespace broadside::gpu {
namespace {

// One warp.

TEST(FloatDivisor, GivesWholeQuotients) {
  for (std::uint32_t by = 1; by <= 512; ++by) {
    const FloatDivisor divisor(by);
    for (std::uint32_t multiple = 0; multiple + by <= 1U << 20; multiple += by) {
      ASSERT_EQ(divisor.quotient(multiple), multiple / by) << multiple << " by " << by;
      ASSERT_EQ(divisor.quotient(multiple + by - 1), multiple / by) << multiple + by - 1 << " by " << by;
    }
    EXPECT_EQ(divisor.rounded_up(7 * by), 7U);
    EXPECT_EQ(divisor.rounded_up(7 * by + 1), 8U);
  }
}

TEST(BodyRing, MeetsEveryPairOnce) {
  for (std::uint32_t bodies : {0U, 1U, 2U, 3U, 4U, 7U, 8U, 31U, 64U, 65U, 511U, 512U}) {
    for (std::uint32_t share : {1U, 3U, 4U, 7U, 32U}) {
      std::map<core::Pair, int> met;
      on_host::run(on_host::kOneWarp, 0, [&](unsigned char*) {
        const BodyRing<FloatDivisor> ring(bodies, share, FloatDivisor(ring_shares(bodies, share)));
        for (std::uint32_t item = 0; item < ring.items(); ++item) {
          const auto own = ring.pair_of(item);
          if (own.exists) ++met[core::make_pair_of(own.i, own.j)];
        }
      });
      EXPECT_EQ(met.size(), std::size_t{bodies} * (bodies == 0 ? 0 : bodies - 1) / 2) << bodies << " by " << share;
      for (const auto& [pair, times] : met) {
        EXPECT_EQ(times, 1) << pair.i << ' ' << pair.j;
        EXPECT_LT(pair.i, pair.j);
        EXPECT_LT(pair.j, bodies);
      }
    }
  }
}

std::uint64_t ring_items(std::uint32_t bodies, std::uint32_t share) {
  return std::uint64_t{bodies} * ((bodies / 2 + share - 1) / share);
}

TEST(BodyRing, SharesAreAsSmallAsTheWarpsAllow) {
  const LaunchShape shape{512, 132, 0, 132};
  const std::uint64_t warps = 132 * 16;
  for (std::uint32_t bodies = 0; bodies <= 512; ++bodies) {
    const std::uint32_t share = ring_share(bodies, shape);
    ASSERT_GE(share, 1U);
    ASSERT_LE(share, 32U) << "a lane each";
    EXPECT_TRUE(share == 32 || ring_items(bodies, share) <= warps) << bodies;
    EXPECT_TRUE(share == 1 || ring_items(bodies, share - 1) > warps) << bodies;
  }
}

TEST(EightByEightHits, AreTakenFromTheLowest) {
  EightByEightHits hits{1U << 3 | 1U << 31, 1U | 1U << 30};
  for (std::uint32_t bit : {3U, 31U, 32U, 62U}) {
    ASSERT_TRUE(hits.any());
    EXPECT_EQ(hits.take(), bit);
  }
  EXPECT_FALSE(hits.any());
  EXPECT_EQ(hits.take(), 63U) << "of none";
  EXPECT_FALSE(hits.any());
}

std::vector<core::Vec3> random_vertices(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::vector<core::Vec3> vertices;
  for (std::size_t k = 0; k < count; ++k) vertices.push_back({place(random), place(random), place(random)});
  return vertices;
}

template <unsigned kAtOnce>
bool descends_in_warp(const std::vector<PackedBox>& boxes, const PlacedShape& a, const PlacedShape& b) {
  bool all = true;
  bool any = false;
  on_host::run(on_host::kOneWarp, 0, [&](unsigned char*) {
    Uncounted work;
    const bool own = descends<kAtOnce>(OctreesInMemory{boxes.data()}, a, b, work);
    all = all && own;
    any = any || own;
  });
  EXPECT_EQ(all, any) << "lanes disagree";
  return any;
}

// With so few vertices, octants are small or empty: bodies whose boxes overlap may still not meet at a deeper level.
TEST(LevelDescent, IsThatOfTheMethod) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> shift(-1.8F, 1.8F);
  int confirmed = 0;
  int rejected = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<PackedBox> boxes;
    std::vector<core::NodeBoxes> nodes;
    for (int shape = 0; shape < 2; ++shape) {
      const core::BodyOctree tree = core::build_body_octree(random_vertices(random, 20 + random() % 300));
      for (const core::Box& box : tree.boxes) boxes.push_back(pack(box));
      nodes.push_back(core::node_boxes(tree));
    }
    const core::Vec3 xa{10.0F, -3.0F, 0.5F};
    const core::Vec3 xb = xa + core::Vec3{shift(random), shift(random), shift(random)};
    const bool wanted = core::is_confirmed(core::Levels::kB, nodes[0], xa, nodes[1], xb);
    (wanted ? confirmed : rejected) += 1;
    EXPECT_EQ(descends_in_warp<1>(boxes, {xa, 0}, {xb, 1}), wanted) << round;
    EXPECT_EQ(descends_in_warp<2>(boxes, {xa, 0}, {xb, 1}), wanted) << round;
  }
  EXPECT_GT(confirmed, 50) << rejected;
  EXPECT_GT(rejected, 50);
}

}  // namespace
}  // namespace broadside::gpu
