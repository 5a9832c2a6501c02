// Candidates of continuous collision: each is found once, and none shares a vertex. The expected counts are worked out
// by hand.
#include "core/continuous/feature_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "datasets/motions/motions.hpp"

namespace broadside::continuous {
namespace {

std::vector<core::Pair> overlapping(const MovingSurface& surface) {
  const std::vector<core::Box> boxes = swept_boxes(surface);
  std::vector<core::Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
  return pairs;
}

FeaturePairs candidates(const MovingSurface& surface) {
  const SurfaceFeatures features = features_of(surface);
  FeaturePairs out;
  CandidateFinder(surface, features).add(overlapping(surface), out);
  return out;
}

// Two triangles without a common vertex; the second one falls through the first one's plane.
MovingSurface two_triangles() {
  MovingSurface s;
  s.name = "two triangles";
  s.start = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  s.end = s.start;
  for (int k = 3; k < 6; ++k) s.end[k].z = -1.0F;
  s.triangles = {{0, 1, 2}, {3, 4, 5}};
  return s;
}

// Each vertex sweeps through the box of the other face, 3 + 3; every edge's box meets each of the other's, since all
// have a corner of one square in common.
TEST(FeatureCandidates, TwoTriangles) {
  MovingSurface s = two_triangles();
  EXPECT_EQ(candidates(s).vertex_face.size(), 6U);
  EXPECT_EQ(candidates(s).edge_edge.size(), 9U);
  s.end = s.start;
  EXPECT_EQ(candidates(s).count(), 0U) << "nothing moves";
  s = two_triangles();
  s.part = {0, 0};
  s.parts_meet_themselves = false;
  EXPECT_EQ(candidates(s).count(), 0U) << "both are one rigid body";
  s.part = {0, 1};
  EXPECT_EQ(candidates(s).count(), 15U);
}

// Neighbors share an edge, and the two vertices off that edge change places. What is left: each of these two vertices
// with the other face, and the two pairs of edges that share no vertex.
TEST(FeatureCandidates, NeighborsOfOneSheet) {
  MovingSurface s;
  s.start = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  s.end = {{1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  s.triangles = {{0, 1, 2}, {3, 2, 1}};
  const SurfaceFeatures features = features_of(s);
  EXPECT_EQ(features.edges.size(), 5U);
  const FeaturePairs found = candidates(s);
  EXPECT_EQ(found.vertex_face, (std::vector<FeaturePair>{{0, 1}, {3, 0}}));
  ASSERT_EQ(found.edge_edge.size(), 2U);
  for (const FeaturePair p : found.edge_edge)
    for (const std::uint32_t v : features.edges[p.first])
      for (const std::uint32_t w : features.edges[p.second]) EXPECT_NE(v, w);
}

TEST(FeatureCandidates, PairsOfTrianglesGiveWhatAllPairsOfFeaturesGiveEachOnce) {
  for (const char* spec : {"folding-sheet:1024", "moving-heap:2560"}) {
    const MovingSurface s = datasets::make_motion(spec).value();
    ASSERT_TRUE(check(s).ok());
    const SurfaceFeatures features = features_of(s);
    FeaturePairs found = candidates(s);
    FeaturePairs all = CandidateFinder(s, features).try_all();
    EXPECT_EQ(digest_of(found), digest_of(all)) << spec;
    for (FeaturePairs* pairs : {&found, &all}) {
      std::sort(pairs->vertex_face.begin(), pairs->vertex_face.end());
      std::sort(pairs->edge_edge.begin(), pairs->edge_edge.end());
    }
    EXPECT_GT(found.vertex_face.size(), 200U);
    EXPECT_GT(found.edge_edge.size(), 200U);
    EXPECT_EQ(found.vertex_face, all.vertex_face) << spec;
    EXPECT_EQ(found.edge_edge, all.edge_edge) << spec;
    all.vertex_face.pop_back();
    EXPECT_NE(digest_of(found), digest_of(all)) << "a candidate less is another digest";
  }
}

TEST(MovingSurface, SaysWhatIsWrong) {
  MovingSurface s = two_triangles();
  s.triangles[1][2] = 6;
  EXPECT_EQ(check(s).error().where, "two triangles, triangle 1");
  s = two_triangles();
  s.end[4].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(check(s).error().where, "two triangles, vertex 4");
  s = two_triangles();
  s.end.pop_back();
  EXPECT_FALSE(check(s).ok());
  core::Mesh from, to;
  from.vertices = to.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  from.triangles = {{0, 1, 2}};
  to.triangles = {{0, 2, 1}};
  EXPECT_FALSE(surface_between(from, to).ok());
  to.triangles = from.triangles;
  EXPECT_TRUE(surface_between(from, to).ok());
}

}  // namespace
}  // namespace broadside::continuous
