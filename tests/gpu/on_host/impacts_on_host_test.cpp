// The kernels of continuous collision on fibers of the host give the same bits as one query after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "core/continuous/feature_candidates.hpp"
#include "core/continuous/feature_impact.hpp"
#include "datasets/motions/motions.hpp"
#include "gpu/continuous/impact_finder.hpp"

namespace broadside::gpu {
namespace {

using continuous::FeatureKind;

std::uint64_t bits_of(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

class ImpactsOnHost : public testing::TestWithParam<const char*> {
 protected:
  ImpactsOnHost() {
    surface_ = datasets::make_motion(GetParam()).value();
    // In units of 1e-30 m some coordinates must be scaled before they are multiplied.
    if (std::string(GetParam()).starts_with("moving-heap"))
      for (auto* places : {&surface_.start, &surface_.end})
        for (core::Vec3& p : *places) p = 1e-30F * p;
    features_ = continuous::features_of(surface_);
    pairs_ = continuous::CandidateFinder(surface_, features_).try_all();
  }

  [[nodiscard]] std::vector<double> one_by_one(FeatureKind kind) const {
    std::vector<double> times;
    for (const auto pair : kind == FeatureKind::kVertexFace ? pairs_.vertex_face : pairs_.edge_edge) {
      const auto found = continuous::first_impact(moving_features(surface_, features_, kind, pair));
      times.push_back(found.touches ? found.time : kNoTouch);
    }
    return times;
  }

  continuous::MovingSurface surface_;
  continuous::SurfaceFeatures features_;
  continuous::FeaturePairs pairs_;
};

TEST_P(ImpactsOnHost, EveryTimeHasTheSameBits) {
  for (const std::uint32_t queries : {1U << 20U, 700U}) {
    ImpactFinder finder({queries, 1000});
    ASSERT_TRUE(finder.load(surface_, features_, pairs_).ok());
    ASSERT_TRUE(finder.find_times().ok());
    const ImpactTimes found = finder.read_back().value();
    for (const auto kind : {FeatureKind::kVertexFace, FeatureKind::kEdgeEdge}) {
      const auto expected = one_by_one(kind);
      const auto& times = kind == FeatureKind::kVertexFace ? found.vertex_face : found.edge_edge;
      ASSERT_EQ(times.size(), expected.size());
      EXPECT_GT(std::count_if(times.begin(), times.end(), [](double t) { return t <= 1.0; }), 10);
      for (std::size_t k = 0; k < times.size(); ++k) ASSERT_EQ(bits_of(times[k]), bits_of(expected[k])) << k;
    }
  }
}

// At first there is room for a single touch, which is too little: the finder gets more room and asks again.
TEST_P(ImpactsOnHost, TheEarliestIsTheLeastOfAll) {
  FirstHit least;
  for (const auto kind : {FeatureKind::kVertexFace, FeatureKind::kEdgeEdge}) {
    const auto times = one_by_one(kind);
    const auto& pairs = kind == FeatureKind::kVertexFace ? pairs_.vertex_face : pairs_.edge_edge;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const bool is_less =
          times[k] < least.time || (times[k] == least.time && kind == least.kind && pairs[k] < least.pair);
      if (times[k] <= 1.0 && (!least.touches || is_less)) least = {true, times[k], kind, pairs[k]};
    }
  }
  ASSERT_TRUE(least.touches);
  for (const ImpactFinderOptions options : {ImpactFinderOptions{1U << 20U, 1}, ImpactFinderOptions{300, 1000}}) {
    ImpactFinder finder(options);
    ASSERT_TRUE(finder.load(surface_, features_, pairs_).ok());
    const FirstHit found = finder.find_earliest().value();
    EXPECT_TRUE(found.touches);
    EXPECT_EQ(bits_of(found.time), bits_of(least.time));
    EXPECT_EQ(found.kind, least.kind);
    EXPECT_EQ(found.pair, least.pair);
  }
}

TEST(ImpactsOnHostWithout, NothingTouchesWhatStandsStill) {
  continuous::MovingSurface surface = datasets::make_motion("folding-sheet:256").value();
  surface.end = surface.start;
  const auto features = continuous::features_of(surface);
  ImpactFinder finder;
  ASSERT_TRUE(finder.load(surface, features, continuous::CandidateFinder(surface, features).try_all()).ok());
  EXPECT_FALSE(finder.find_earliest().value().touches);
}

INSTANTIATE_TEST_SUITE_P(Motions, ImpactsOnHost, testing::Values("folding-sheet:1024", "moving-heap:2560"),
                         [](const auto& motion) { return motion.index == 0 ? "FoldingSheet" : "MovingHeap"; });

}  // namespace
}  // namespace broadside::gpu
