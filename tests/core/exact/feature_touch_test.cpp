// The first touch of moving features: closed answers, brute-force subdivision, and the arbiter against itself at two
// precisions and with its points renamed.
#include "core/exact/feature_touch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/exact/triangle_distance.hpp"
#include "tests/core/exact/moving_cases.hpp"

namespace broadside::exact {
namespace {

using continuous::FeatureKind;
using continuous::MovingFeatures;
using core::Vec3d;

MovingFeatures vertex_face(Vec3d from, Vec3d to) {
  return {FeatureKind::kVertexFace, {from, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {to, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
}

void expect_touch_at(const TouchTime& found, double t) {
  EXPECT_TRUE(found.touches);
  EXPECT_LE(found.lower, t);
  EXPECT_GE(found.upper, t);
  EXPECT_LE(found.upper - found.lower, 0x1p-53);
}

TEST(FeatureTouch, AVertexThatFallsOnATriangle) {
  expect_touch_at(first_touch(vertex_face({0.25, 0.25, 1}, {0.25, 0.25, -1})), 0.5);
  // A third is between two doubles; the bracket holds both.
  const TouchTime third = first_touch(vertex_face({0.25, 0.25, 1}, {0.25, 0.25, -2}));
  expect_touch_at(third, 1.0 / 3.0);
  EXPECT_LT(third.lower, third.upper);
  expect_touch_at(first_touch(vertex_face({0.5, 0.5, 1}, {0.5, 0.5, 0})), 1.0);   // on an edge, at the very end
  expect_touch_at(first_touch(vertex_face({0.2, 0.2, 0}, {0.2, 0.2, -1})), 0.0);  // at the start
  EXPECT_FALSE(first_touch(vertex_face({0.5, 0.5, 1}, {0.5, 0.5, 0x1p-1070})).touches);
  EXPECT_FALSE(first_touch(vertex_face({0.5, std::nextafter(0.5, 1.0), 1}, {0.5, 0.75, -1})).touches);
}

// The plane z = t (x + y) and the vertex (t/2, t/2, z): they meet where t^2 = z.
MovingFeatures tilting_plane(double z_start, double z_end) {
  return {FeatureKind::kVertexFace,
          {{0, 0, z_start}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
          {{0.5, 0.5, z_end}, {0, 0, 0}, {1, 0, 1}, {0, 1, 1}}};
}

TEST(FeatureTouch, RootsThatAreNoFractions) {
  expect_touch_at(first_touch(tilting_plane(0.5, 0.5)), std::sqrt(0.5));
  // t^2 = t - 1/4 has the double root 1/2: the vertex grazes the plane. Slightly lower, it does not.
  expect_touch_at(first_touch(tilting_plane(-0.25, 0.75)), 0.5);
  const double hair = 0x1p-52;
  EXPECT_FALSE(first_touch(tilting_plane(-0.25 - hair, 0.75 - hair)).touches);
  // With the plane higher by 2^-52, it is met 2^-26 earlier.
  expect_touch_at(first_touch(tilting_plane(-0.25 + hair, 0.75 + hair)), 0.5 - 0x1p-26);
}

TEST(FeatureTouch, EdgesThatCrossSlideOrStand) {
  const auto edges = [](Vec3d a_from, Vec3d b_from, Vec3d a_to, Vec3d b_to) {
    return MovingFeatures{
        FeatureKind::kEdgeEdge, {{0, 0, 0}, {1, 0, 0}, a_from, b_from}, {{0, 0, 0}, {1, 0, 0}, a_to, b_to}};
  };
  expect_touch_at(first_touch(edges({0.5, -1, 3}, {0.5, 1, 3}, {0.5, -1, -1}, {0.5, 1, -1})), 0.75);
  // Parallel, one above the other.
  expect_touch_at(first_touch(edges({-2, 0, 1}, {0.5, 0, 1}, {-2, 0, -1}, {0.5, 0, -1})), 0.5);
  // On one line, head on: the gap of 1 closes at speed 4.
  expect_touch_at(first_touch(edges({2, 0, 0}, {3, 0, 0}, {-2, 0, 0}, {-1, 0, 0})), 0.25);
  // In one plane, the corner at (2, 1) reaches the edge's end at (1, 0).
  expect_touch_at(first_touch(edges({2, 1, 0}, {3, 1, 0}, {0, -1, 0}, {1, -1, 0})), 0.5);
  // Standstill: crossing edges touch at once, others never.
  expect_touch_at(first_touch(edges({0.5, -1, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 1, 0})), 0.0);
  EXPECT_FALSE(first_touch(edges({1.5, -1, 0}, {1.5, 1, 0}, {1.5, -1, 0}, {1.5, 1, 0})).touches);
  // Edges that are points.
  expect_touch_at(first_touch(edges({0.5, 0, 1}, {0.5, 0, 1}, {0.5, 0, -3}, {0.5, 0, -3})), 0.25);
}

// In units of 1e-290 and of 1e290, and with both in one query: the answer does not change with the unit.
TEST(FeatureTouch, ScalesAtTheEndsOfTheRange) {
  for (const double s : {0x1p-1000, 0x1p+1000}) {
    MovingFeatures f = vertex_face({0.25, 0.25, 1}, {0.25, 0.25, -2});
    for (int k = 0; k < 4; ++k) {
      f.start[k] = s * f.start[k];
      f.end[k] = s * f.end[k];
    }
    expect_touch_at(first_touch(f), 1.0 / 3.0);
  }
  expect_touch_at(first_touch(vertex_face({0x1p-1000, 0x1p-1000, 0x1p+1000}, {0.25, 0.25, -0x1p+1000})), 0.5);
}

// The vertex (1/3, 1/3, 1/3) ends exactly on the plane x + y + z = 1. In doubles it ends slightly below it.
TEST(FeatureTouch, FractionsThatDoublesCannotHold) {
  RationalFeatures query = to_rational({FeatureKind::kVertexFace,
                                        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  query.points[4] = {{{"1", "3"}, {"1", "3"}, {"1", "3"}}};
  const auto exact = first_touch(query);
  ASSERT_TRUE(exact.ok());
  expect_touch_at(exact.value(), 1.0);
  const auto near = rounded(query);
  ASSERT_TRUE(near.ok());
  EXPECT_EQ(near.value().end[0].x, 1.0 / 3.0);
  EXPECT_FALSE(first_touch(near.value()).touches);
  query.points[4][0] = {"100000000000000000000000000000000000001", "300000000000000000000000000000000000000"};
  EXPECT_TRUE(first_touch(query).value().touches);
  query.points[4][1] = {"1", "0"};
  EXPECT_NE(first_touch(query).error().line().find("point 4, axis y"), std::string::npos);
  query.points[4][1] = {"1.5", "2"};
  EXPECT_FALSE(first_touch(query).ok());
}

// Point pairs of two features at parameters u, v: the difference is linear in t, in u and in v, so its values in a box
// of these lie in the hull of those at the box's eight corners.
struct ParameterBox {
  double low[3];  // t, u, v
  double high[3];
};

Vec3d difference(const MovingFeatures& f, double t, double u, double v) {
  using tests::at_time;
  const Vec3d a = at_time(f, 0, t), b = at_time(f, 1, t), c = at_time(f, 2, t), d = at_time(f, 3, t);
  if (f.kind == FeatureKind::kVertexFace) return a - ((1.0 - u - v) * b + u * c + v * d);
  return ((1.0 - u) * a + u * b) - ((1.0 - v) * c + v * d);
}

bool may_hold_zero(const MovingFeatures& f, const ParameterBox& box) {
  constexpr double kRounding = 1e-14;  // coordinates up to 5, a dozen operations
  Vec3d low, high;
  for (int corner = 0; corner < 8; ++corner) {
    double at[3];
    for (int k = 0; k < 3; ++k) at[k] = (corner >> k & 1) != 0 ? box.high[k] : box.low[k];
    const Vec3d d = difference(f, at[0], at[1], at[2]);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = corner == 0 ? d[axis] : std::min(low[axis], d[axis]);
      high[axis] = corner == 0 ? d[axis] : std::max(high[axis], d[axis]);
    }
  }
  const bool is_outside = f.kind == FeatureKind::kVertexFace && box.low[1] + box.low[2] > 1.0;
  return !is_outside && std::max({low.x, low.y, low.z}) <= kRounding &&
         std::min({high.x, high.y, high.z}) >= -kRounding;
}

// The beginning of the first box, of side 2^-levels, that may hold a common point; 2 when there is none.
double first_by_subdivision(const MovingFeatures& f, ParameterBox box, int split, int levels) {
  if (!may_hold_zero(f, box)) return 2.0;
  if (split == 3 * levels) return box.low[0];
  const int k = split % 3;
  ParameterBox half[2] = {box, box};
  half[0].high[k] = half[1].low[k] = 0.5 * (box.low[k] + box.high[k]);
  const double first = first_by_subdivision(f, half[0], split + 1, levels);
  if (k == 0 && first < 2.0) return first;
  return std::min(first, first_by_subdivision(f, half[1], split + 1, levels));
}

double distance_at(const MovingFeatures& f, double t) {
  Point p[4];
  for (int k = 0; k < 4; ++k) {
    const Vec3d x = tests::at_time(f, k, t);
    p[k] = {x.x, x.y, x.z};
  }
  return std::sqrt((f.kind == FeatureKind::kVertexFace ? nearest_of_point_and_triangle(p[0], {p[1], p[2], p[3]})
                                                       : nearest_of_segments(p[0], p[1], p[2], p[3]))
                       .squared_m2);
}

TEST(FeatureTouch, SubdivisionFindsNothingEarlierAndNothingElse) {
  constexpr int kLevels = 9;
  std::mt19937_64 random(17);
  int touching = 0;
  int close = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const MovingFeatures f = tests::some_features(random);
    const TouchTime found = first_touch(f);
    const double first = first_by_subdivision(f, {{0, 0, 0}, {1, 1, 1}}, 0, kLevels);
    if (!found.touches) continue;
    ++touching;
    ASSERT_LE(first, found.upper) << "trial " << trial << ": not late";
    ASSERT_LT(distance_at(f, found.lower), 1e-12) << "trial " << trial << ": they do touch then";
    close += first > found.lower - 3.0 * std::ldexp(1.0, -kLevels) ? 1 : 0;
  }
  EXPECT_GT(touching, 300);
  EXPECT_GT(close, touching * 9 / 10) << "subdivision that resolves nothing proves nothing";
}

TEST(FeatureTouch, WhereSubdivisionProvesThereIsNoneThereIsNone) {
  std::mt19937_64 random(18);
  int proved = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const MovingFeatures f = tests::some_features(random);
    if (first_by_subdivision(f, {{0, 0, 0}, {1, 1, 1}}, 0, 6) < 2.0) continue;
    ASSERT_FALSE(first_touch(f).touches) << "trial " << trial;
    ++proved;
  }
  EXPECT_GT(proved, 1000);
}

// The same features with their points in another order, or read as fractions, are other polynomials with one answer;
// and a coarse bracket holds the fine one.
void expect_consistent(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  int touching = 0;
  for (int trial = 0; trial < count; ++trial) {
    const MovingFeatures f = tests::some_features(random);
    const TouchTime fine = first_touch(f);
    const TouchTime coarse = first_touch(f, 12);
    ASSERT_EQ(fine.touches, coarse.touches) << "trial " << trial;
    ASSERT_LE(coarse.lower, fine.lower) << "trial " << trial;
    ASSERT_GE(coarse.upper, fine.upper) << "trial " << trial;
    MovingFeatures other = f;
    const bool is_face = f.kind == FeatureKind::kVertexFace;
    std::swap(other.start[is_face ? 1 : 0], other.start[is_face ? 3 : 1]);
    std::swap(other.end[is_face ? 1 : 0], other.end[is_face ? 3 : 1]);
    const TouchTime renamed = first_touch(other);
    ASSERT_EQ(fine.touches, renamed.touches) << "trial " << trial;
    ASSERT_EQ(fine.lower, renamed.lower) << "trial " << trial;
    ASSERT_EQ(fine.upper, renamed.upper) << "trial " << trial;
    touching += fine.touches ? 1 : 0;
    if (trial % 16 != 0) continue;
    const auto as_fractions = first_touch(to_rational(f));
    ASSERT_TRUE(as_fractions.ok());
    ASSERT_EQ(fine.lower, as_fractions.value().lower) << "trial " << trial;
  }
  EXPECT_GT(touching, count / 20);
  EXPECT_LT(touching, count / 2);
}

TEST(FeatureTouch, TwoPrecisionsAndTwoOrdersAgree) {
  expect_consistent(19, 10'000);
}
TEST(FeatureTouch, SlowAMillionCasesAgree) {
  expect_consistent(20, 1'000'000);
}

}  // namespace
}  // namespace broadside::exact
