// Long searches that a team of warps hands over, and that the whole grid continues.
#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <vector>

#include "core/engine/engine.hpp"
#include "gpu/frame/pipeline.hpp"
#include "gpu/stages/small_counts.cuh"
#include "gpu/stages/vertices/leftover_work.cuh"
#include "reference/engines.hpp"
#include "tests/gpu/small_scenes.hpp"
#include "tests/gpu/twin_comparison.hpp"

namespace broadside::gpu {
namespace {

TEST(SmallCounts, AreFoundAgainInTheWordWhereBlocksMeet) {
  const SmallCounts most{130816, 130816, (1U << 14) - 1};
  for (const SmallCounts& counts : {SmallCounts{}, SmallCounts{1, 2, 3}, most}) {
    const unsigned long long word = counts.packed() + 131 * GridWord::kArrival + GridWord::kFlipped;
    const SmallCounts again = SmallCounts::unpacked(word);
    EXPECT_EQ(again.pairs, counts.pairs);
    EXPECT_EQ(again.judged, counts.judged);
    EXPECT_EQ(again.leftovers, counts.leftovers);
  }
}

TEST(SmallCounts, OfLevelsThatAreLeftTheRejectedAreCounted) {
  const SmallCounts counts{10, 4, 0};
  SmallFrameView view;
  view.levels = core::Levels::kC;
  EXPECT_EQ(counts.confirmed(view), 6U);
  view.are_levels_first = true;
  EXPECT_EQ(counts.confirmed(view), 4U);
}

TEST(GridWord, SharesOfAllBlocksFlipOneBit) {
  for (const std::uint32_t blocks : {1U, 2U, 132U, 1024U}) {
    unsigned long long word = 77;
    for (std::uint32_t b = 0; b < blocks; ++b) word += GridWord::share(b, blocks);
    EXPECT_EQ(word, GridWord::kFlipped + 77) << blocks;
    for (std::uint32_t b = 0; b < blocks; ++b) word += GridWord::share(b, blocks);
    EXPECT_EQ(word, 77U) << blocks;
  }
}

// All entries of three leftovers, spread over seven blocks: each entry is in exactly one block, with its own kind.
TEST(LeftoverPart, OfAllBlocksAreTheRest) {
  constexpr std::uint32_t kBlocks = 7;
  constexpr std::uint32_t kEntries = 64 * 4;
  const std::vector<TeamCounts> handed_over = {{40, 216}, {3, 0}, {0, 0}};
  std::vector<LeftoverSearch> items(LeftoverView::kMost);
  std::vector<NodePair> entries(std::size_t{LeftoverView::kMost} * LeftoverView::kEntries, {999000, 999, 0});
  for (std::uint32_t r = 0; r < handed_over.size(); ++r) {
    LeftoverSearch& leftover = items[r];
    leftover.nodes = handed_over[r].nodes;
    leftover.leaves = handed_over[r].leaves;
    for (std::uint32_t e = 0; e < LeftoverView::kEntries; ++e)
      entries[r * LeftoverView::kEntries + e] = {1000 * r + e, e, 0};
  }
  std::vector<std::vector<std::uint32_t>> stacks(kBlocks, std::vector<std::uint32_t>(3 * 2 * kEntries));
  std::vector<TeamCounts> counts(kBlocks);
  on_host::run({{kBlocks}, {64}, 0}, 0, [&](unsigned char*) {
    const WarpShare share{threadIdx.x / 32, 2};
    const SearchTeam team{share, 0, {stacks[blockIdx.x].data(), 2 * kEntries, 2 * kEntries}, nullptr};
    const LeftoverPart part({items.data(), entries.data()}, static_cast<std::uint32_t>(handed_over.size()), team);
    if (threadIdx.x == 0) counts[blockIdx.x] = part.counts();
  });
  std::vector<std::vector<int>> met(handed_over.size(), std::vector<int>(LeftoverView::kEntries, 0));
  for (std::uint32_t b = 0; b < kBlocks; ++b) {
    const SearchTeam team{{0, 2}, 0, {stacks[b].data(), 2 * kEntries, 2 * kEntries}, nullptr};
    for (std::uint32_t k = 0; k < counts[b].nodes + counts[b].leaves; ++k) {
      const NodePair entry = team.at(counts[b], k);
      const std::uint32_t leftover = entry.a / 1000;
      ASSERT_EQ(leftover, b % handed_over.size());
      EXPECT_EQ(entry.b < handed_over[leftover].nodes, k < counts[b].nodes);
      ++met[leftover][entry.b];
    }
  }
  for (std::uint32_t r = 0; r < handed_over.size(); ++r)
    for (std::uint32_t e = 0; e < LeftoverView::kEntries; ++e)
      EXPECT_EQ(met[r][e], e < handed_over[r].nodes + handed_over[r].leaves ? 1 : 0) << r << ' ' << e;
}

TEST(MeasuredPair, IsImprovedToTheNearestInAnyOrder) {
  const std::vector<core::Proximity> found = {{2.0F, 1, 1}, {1.0F, 7, 3}, {1.0F, 7, 2}, {1.0F, 9, 0}, {3.0F, 0, 0}};
  for (std::size_t first = 0; first < found.size(); ++first) {
    MeasuredPair pair;
    pair.is_rejected = 1;
    for (std::size_t k = 0; k < found.size(); ++k) improve(&pair, found[(first + k) % found.size()]);
    EXPECT_EQ(pair.nearest, (core::Proximity{1.0F, 7, 2}));
    EXPECT_EQ(pair.is_rejected, 1U);
  }
}

// Fine spheres deep in each other, without cells: a few pairs whose searches take many rounds.
TEST(SharedSearches, GiveTheFramesOfTheTwin) {
  SceneShape shape;
  shape.gravity_m_s2 = 0.0F;
  shape.cube_m = 0.9F;
  for (const std::uint32_t bodies : {2U, 4U}) {
    shape.bodies = bodies;
    const core::Scene scene = thrown({bumpy_sphere(24, 0.5F)}, shape);
    for (const std::string name : {"flat", "C"}) {
      SCOPED_TRACE(name + " " + std::to_string(bodies));
      PipelineOptions options;
      options.levels = *core::levels_named(name);
      options.least_for_cells = 1000;
      Pipeline subject(options);
      const core::EngineRow row = reference::octree_cpu_row();
      auto settings = core::Settings::parse(row.id, row.settings, {{"levels", name}});
      ASSERT_TRUE(settings.ok());
      const core::Engine twin = std::move(row.create(settings.value())).value();
      EXPECT_GT(compare_pipelines(scene, subject, *twin.dynamics, 4, 1), 0U);
    }
  }
}

}  // namespace
}  // namespace broadside::gpu
