// Queries side by side, on any number of threads, give the bits of one query after the other; and on surfaces no touch
// is missed or late.
#include "reference/continuous/surface_impacts.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "core/continuous/feature_candidates.hpp"
#include "core/continuous/feature_impact.hpp"
#include "core/exact/feature_touch.hpp"
#include "datasets/motions/motions.hpp"
#include "tests/core/exact/moving_cases.hpp"

namespace broadside::reference {
namespace {

using continuous::FeatureKind;
using continuous::FeaturePairs;
using continuous::MovingFeatures;

std::uint64_t bits_of(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

double alone(const MovingFeatures& f) {
  const continuous::Impact found = continuous::first_impact(f);
  return found.touches ? found.time : kNoTouch;
}

const std::vector<ImpactSettings>& all_settings() {
  static const std::vector<ImpactSettings> settings{
      {Width::kOne, 1}, {Width::kFour, 1}, {Width::kEight, 1}, {Width::kWidest, 2}};
  return settings;
}

// General motions, lattices where much is parallel or flat, and units that must be scaled first. The kinds of query
// alternate in runs of one to three.
TEST(SurfaceImpacts, SideBySideHasTheSameBits) {
  std::mt19937_64 random(41);
  std::vector<MovingFeatures> features;
  for (int k = 0; k < 20000; ++k) {
    MovingFeatures f = tests::some_features(random);
    const double scale = k % 50 == 0 ? 0x1p-900 : (k % 50 == 1 ? 0x1p300 : 1.0);
    for (int p = 0; p < 4; ++p) {
      f.start[p] = scale * f.start[p];
      f.end[p] = scale * f.end[p];
    }
    features.push_back(f);
  }
  std::vector<double> times(features.size());
  for (const ImpactSettings& settings : all_settings()) {
    first_impacts(features, times, settings);
    int touches = 0;
    for (std::size_t k = 0; k < features.size(); ++k) {
      ASSERT_EQ(bits_of(times[k]), bits_of(alone(features[k])))
          << "query " << k << ", " << lanes_of(settings.width) << " side by side";
      touches += times[k] <= 1.0 ? 1 : 0;
    }
    EXPECT_GT(touches, 3000);
  }
}

class OfASurface : public testing::TestWithParam<const char*> {
 protected:
  OfASurface()
      : surface_(datasets::make_motion(GetParam()).value()),
        features_(continuous::features_of(surface_)),
        pairs_(continuous::CandidateFinder(surface_, features_).try_all()) {}

  const continuous::MovingSurface surface_;
  const continuous::SurfaceFeatures features_;
  const FeaturePairs pairs_;
};

TEST_P(OfASurface, EveryTimeIsThatOfTheQueryAndNoneIsMissedOrLate) {
  const SurfaceImpacts impacts(surface_, features_);
  for (const auto kind : {FeatureKind::kVertexFace, FeatureKind::kEdgeEdge}) {
    const auto& pairs = kind == FeatureKind::kVertexFace ? pairs_.vertex_face : pairs_.edge_edge;
    ASSERT_GT(pairs.size(), 500U);
    std::vector<double> times(pairs.size());
    for (const ImpactSettings& settings : all_settings()) {
      impacts.times(kind, pairs, times, settings);
      for (std::size_t k = 0; k < pairs.size(); ++k)
        ASSERT_EQ(bits_of(times[k]), bits_of(alone(moving_features(surface_, features_, kind, pairs[k])))) << k;
    }
    int touching = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto truth = exact::first_touch(moving_features(surface_, features_, kind, pairs[k]));
      if (truth.touches) {
        ASSERT_LE(times[k], truth.upper) << "missed or late: " << k;
      }
      touching += truth.touches ? 1 : 0;
    }
    EXPECT_GT(touching, 10);
  }
}

TEST_P(OfASurface, TheEarliestIsTheLeastOfAllTimes) {
  const SurfaceImpacts impacts(surface_, features_);
  EarliestImpact least;
  for (const auto kind : {FeatureKind::kVertexFace, FeatureKind::kEdgeEdge}) {
    const auto& pairs = kind == FeatureKind::kVertexFace ? pairs_.vertex_face : pairs_.edge_edge;
    std::vector<double> times(pairs.size());
    impacts.times(kind, pairs, times);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (times[k] > 1.0 || (least.touches && times[k] > least.time)) continue;
      if (!least.touches || times[k] < least.time || (kind == least.kind && pairs[k] < least.pair))
        least = {true, times[k], kind, pairs[k]};
    }
  }
  ASSERT_TRUE(least.touches);
  for (const ImpactSettings& settings : all_settings()) {
    const EarliestImpact found = impacts.earliest(pairs_, settings);
    EXPECT_EQ(found, least) << lanes_of(settings.width) << " side by side: " << found.time << ", not " << least.time;
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, OfASurface, testing::Values("folding-sheet:1936", "moving-heap:5120"),
                         [](const auto& motion) { return motion.index == 0 ? "FoldingSheet" : "MovingHeap"; });

}  // namespace
}  // namespace broadside::reference
