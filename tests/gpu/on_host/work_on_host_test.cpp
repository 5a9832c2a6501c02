// The tests that frames make are counted exactly, and the counts depend neither on the order of threads nor on their
// number.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "core/scene/shapes.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/frame/pipeline.hpp"
#include "tests/gpu/work_counts.hpp"

namespace broadside::gpu {
namespace {

Broad broad_named(std::string_view name) {
  if (name == "octree") return Broad::kOctree;
  if (name == "brute") return Broad::kBrute;
  return name == "hash" ? Broad::kHash : Broad::kTree;
}

Counts counts_of_row(const WorkRow& row) {
  if (row.levels.empty()) {
    PairFinder subject({.broad = broad_named(row.broad)});
    return counts_of(subject, counted_boxes());
  }
  PipelineOptions options;
  options.broad = broad_named(row.broad);
  options.levels = *core::levels_named(row.levels);
  Pipeline subject(options);
  return counts_of(subject, counted_scene(), 3);
}

TEST(WorkOnHost, IsTheSameInEveryOrderOfThreads) {
  for (const char* seed : {"0", "5"}) {
    setenv("BROADSIDE_ON_HOST_SEED", seed, 1);
    for (const WorkRow& row : kWorkRows) expect_row(row, counts_of_row(row));
  }
  unsetenv("BROADSIDE_ON_HOST_SEED");
}

// Every body overlaps every other: n (n - 1) / 2 pairs, however they are looked for. With the grid they all lie in one
// cell, and each box meets all entries of it, itself and both orders: n^2.
TEST(WorkOnHost, OfBodiesInOnePlaceIsThatOfAllPairs) {
  constexpr std::uint64_t kBodies = 60;
  const std::vector<core::Box> boxes(kBodies, core::Box{{0.1F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F}});
  for (const Broad broad : {Broad::kTree, Broad::kOctree, Broad::kHash, Broad::kBrute}) {
    PairFinder subject({broad, core::Variant::kSound, 0.5F, 50});
    const Counts counts = counts_of(subject, boxes);
    EXPECT_EQ(counts.at("broad: box tests"), broad == Broad::kTree ? kBodies * kBodies : kBodies * (kBodies - 1) / 2)
        << static_cast<int>(broad);
  }
  PairFinder hash({Broad::kHash, core::Variant::kSound, 0.5F, 50});
  EXPECT_EQ(counts_of(hash, boxes).at("broad: nodes visited"), kBodies) << "an entry of one cell each";
}

// The search for many boxes meets each pair of a cell from one side, with its bins in use or not.
TEST(WorkOnHost, OfManyBoxesInOnePlaceIsThatOfAllPairs) {
  constexpr std::uint64_t kBodies = 60;
  const std::vector<core::Box> boxes(kBodies, core::Box{{0.1F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F}});
  for (const std::uint32_t least_for_bins : {1U, 1000U}) {
    PairFinder subject({.least_for_grid = 10, .least_for_bulk = 10, .least_for_bins = least_for_bins});
    EXPECT_EQ(counts_of(subject, boxes).at("broad: box tests"), kBodies * (kBodies - 1) / 2);
    PairFinder of_many({.least_for_grid = 10, .least_for_bulk = 10, .least_for_bins = least_for_bins});
    const Counts counts = counts_of(of_many, counted_boxes());
    EXPECT_EQ(counts.at("broad: box tests"), kBulkTests);
    EXPECT_EQ(counts.at("broad: nodes visited"), kBulkNodes);
  }
}

TEST(WorkOnHost, OfSixtyThousandBoxes) {
  PairFinder subject({});
  const Counts counts = counts_of(subject, bulk_counted_boxes());
  EXPECT_EQ(counts.at("broad: box tests"), kTestsOfMore);
  EXPECT_EQ(counts.at("broad: nodes visited"), kNodesOfMore);
}

// Boxes far apart: the grid looks into cells and finds each box alone in its own.
TEST(WorkOnHost, OfLonelyBodiesIsAVisitAndNoPartner) {
  constexpr std::uint64_t kBodies = 60;
  std::vector<core::Box> boxes;
  for (std::uint64_t i = 0; i < kBodies; ++i) {
    const float at = 100.0F * static_cast<float>(i);
    boxes.push_back({{at, 0.1F, 0.1F}, {at + 0.5F, 0.6F, 0.6F}});
  }
  PairFinder hash({Broad::kHash, core::Variant::kSound, 4.0F, 50});
  EXPECT_EQ(counts_of(hash, boxes).at("broad: box tests"), 0U);
  PairFinder tree({Broad::kTree, core::Variant::kSound, 0.5F, 50});
  const Counts counts = counts_of(tree, boxes);
  EXPECT_GE(counts.at("broad: box tests"), kBodies) << "itself";
  EXPECT_GE(counts.at("broad: nodes visited"), kBodies);
}

// For one pair of bodies, A tests all level-2 boxes of one against all of the other, and level1 tests 8 x 8 boxes.
// Below that, B tests 8 x 8 children of each hit until two of them meet: more tests than level1, fewer than all.
TEST(WorkOnHost, OfOnePairIsThatOfItsLevels) {
  SceneShape shape;
  shape.bodies = 2;
  shape.cube_m = 0.3F;
  const core::Scene scene = thrown({bumpy_sphere(12, 0.5F)}, shape);
  PipelineOptions options;
  options.broad = Broad::kBrute;
  const auto tests = [&](core::Levels levels) {
    options.levels = levels;
    Pipeline subject(options);
    return counts_of(subject, scene, 1).at("level stage: box tests");
  };
  EXPECT_EQ(tests(core::Levels::kLevel1), 64U);
  const core::ShapeTable table = core::build_shapes(scene);
  const auto leaves_of = [&](std::size_t body) {
    const auto& begin = table.shapes[table.shape_of_body[body]].octree.leaf_begin;
    std::uint64_t leaves = 0;
    for (std::size_t k = 0; k < 64; ++k) leaves += begin[k + 1] > begin[k] ? 1U : 0U;
    return leaves;
  };
  EXPECT_EQ(tests(core::Levels::kA), leaves_of(0) * leaves_of(1));
  const std::uint64_t of_b = tests(core::Levels::kB);
  EXPECT_GE(of_b, 128U);
  EXPECT_EQ(of_b % 64, 0U);
  EXPECT_LE(of_b, 65U * 64U);
}

// Counting is no part of what is timed: unless it is asked for, nothing is counted.
TEST(WorkOnHost, IsNotCountedWhereNobodyAsked) {
  const core::Scene scene = counted_scene();
  Pipeline subject(PipelineOptions{});
  ASSERT_TRUE(subject.load(scene).ok());
  ASSERT_TRUE(subject.step(scene.dt_s).ok());
  EXPECT_EQ(counts_of(subject).count("level stage: box tests"), 0U);
}

// Counting starts anew with each load.
TEST(WorkOnHost, IsOfTheLastLoad) {
  Pipeline subject(PipelineOptions{});
  const core::Scene scene = counted_scene();
  const Counts once = counts_of(subject, scene, 3);
  EXPECT_EQ(counts_of(subject, scene, 3), once);
  EXPECT_GT(counts_of(subject, scene, 4).at("broad: box tests"), once.at("broad: box tests"));
}

}  // namespace
}  // namespace broadside::gpu
