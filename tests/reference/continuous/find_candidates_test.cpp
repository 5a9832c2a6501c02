// Candidates through the broad phases: each gives the same set, which is that of trying every pair of features.
#include "reference/continuous/find_candidates.hpp"

#include <gtest/gtest.h>

#include "datasets/motions/motions.hpp"
#include "reference/engines.hpp"

namespace broadside::reference {
namespace {

using continuous::CandidateFinder;
using continuous::MovingSurface;
using continuous::SurfaceFeatures;

std::vector<core::Pair> pairs_by(const core::EngineRow& row, const std::vector<core::Box>& boxes) {
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value()).value();
  const std::vector<std::uint8_t> is_static(boxes.size());
  EXPECT_TRUE(engine.broad_phase->load(boxes, is_static).ok());
  EXPECT_TRUE(engine.broad_phase->find().ok());
  return engine.broad_phase->read_back().value().pairs;
}

class FindCandidates : public testing::TestWithParam<const char*> {};

TEST_P(FindCandidates, EveryBroadPhaseGivesTheSameSet) {
  const MovingSurface surface = datasets::make_motion(GetParam()).value();
  const SurfaceFeatures features = continuous::features_of(surface);
  const CandidateFinder finder(surface, features);
  const std::uint64_t expected = continuous::digest_of(finder.try_all());
  const std::vector<core::Box> boxes = continuous::swept_boxes(surface);
  int asked = 0;
  for (const EngineRowFunction make : engine_rows()) {
    const core::EngineRow row = make();
    if (row.capabilities.find("broad") == std::string_view::npos || (row.absent != nullptr && !row.absent().empty()))
      continue;
    const auto found = find_candidates(finder, pairs_by(row, boxes), 2);
    EXPECT_EQ(continuous::digest_of(found), expected) << row.id;
    ++asked;
  }
  EXPECT_GE(asked, 8);
}

TEST_P(FindCandidates, TheOrderDoesNotDependOnTheWorkers) {
  const MovingSurface surface = datasets::make_motion(GetParam()).value();
  const SurfaceFeatures features = continuous::features_of(surface);
  const CandidateFinder finder(surface, features);
  const std::vector<core::Box> boxes = continuous::swept_boxes(surface);
  const std::vector<core::Pair> pairs = pairs_by(octree_cpu_row(), boxes);
  const auto one = find_candidates(finder, pairs, 1);
  const auto two = find_candidates(finder, pairs, 2);
  EXPECT_GT(one.count(), 1000U);
  EXPECT_EQ(one.vertex_face, two.vertex_face);
  EXPECT_EQ(one.edge_edge, two.edge_edge);
}

INSTANTIATE_TEST_SUITE_P(Motions, FindCandidates, testing::Values("folding-sheet:2000", "moving-heap:3200"),
                         [](const auto& motion) { return motion.index == 0 ? "FoldingSheet" : "MovingHeap"; });

}  // namespace
}  // namespace broadside::reference
