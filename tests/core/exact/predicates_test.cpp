// Orientation and meeting of triangles where rounding decides everything: expected signs from whole numbers, which are
// exact in 128 bits.
#include "core/exact/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace broadside::exact {
namespace {

using Whole = std::array<std::int64_t, 3>;

// Exact for coordinates below 2^40.
int sign_of_determinant(Whole a, Whole b, Whole c, Whole d) {
  std::array<std::array<__int128, 3>, 3> m;
  for (int k = 0; k < 3; ++k) {
    m[0][k] = a[k] - d[k];
    m[1][k] = b[k] - d[k];
    m[2][k] = c[k] - d[k];
  }
  const __int128 determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return determinant > 0 ? 1 : (determinant < 0 ? -1 : 0);
}

Point point(Whole w, double scale = 1.0) {
  return {scale * static_cast<double>(w[0]), scale * static_cast<double>(w[1]), scale * static_cast<double>(w[2])};
}

// d is a whole combination of a, b and c plus at most a unit: on their plane or very near it, far from the origin.
TEST(Predicates, OrientationNearAPlaneIsThatOfWholeNumbers) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> at(-(1LL << 38), 1LL << 38);
  std::uniform_int_distribution<std::int64_t> part(-3, 3);
  std::uniform_int_distribution<std::int64_t> hair(-1, 1);
  int on_plane = 0;
  for (int n = 0; n < 20000; ++n) {
    Whole a, b, c, d;
    const std::int64_t s = part(random);
    const std::int64_t t = part(random);
    for (int k = 0; k < 3; ++k) {
      a[k] = at(random) >> 4;
      b[k] = a[k] + (at(random) >> 6);
      c[k] = a[k] + (at(random) >> 6);
      d[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + (n % 2 == 0 ? 0 : hair(random));
    }
    const int expected = sign_of_determinant(a, b, c, d);
    on_plane += expected == 0 ? 1 : 0;
    ASSERT_EQ(orientation(point(a), point(b), point(c), point(d)), expected);
    ASSERT_EQ(orientation(point(a, 0x1p-30), point(b, 0x1p-30), point(c, 0x1p-30), point(d, 0x1p-30)), expected);
    ASSERT_EQ(orientation(point(b), point(a), point(c), point(d)), -expected) << "swapped";
  }
  EXPECT_GT(on_plane, 9000);
}

// By all planes of three points: two triangles on a small lattice meet when their difference contains the origin. That
// is the case when no direction among normals, edge crosses and in-plane edge normals separates them strictly.
bool meet_by_separating_axes(const std::array<Whole, 3>& p, const std::array<Whole, 3>& q) {
  const auto minus = [](Whole a, Whole b) { return Whole{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto times = [](Whole a, Whole b) {
    return Whole{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  std::vector<Whole> edges, axes;
  for (int k = 0; k < 3; ++k) edges.push_back(minus(p[(k + 1) % 3], p[k]));
  for (int k = 0; k < 3; ++k) edges.push_back(minus(q[(k + 1) % 3], q[k]));
  // Vectors between the corners make the axes complete for triangles that are segments or points.
  std::vector<Whole> along = edges;
  for (const Whole& a : p)
    for (const Whole& b : q) along.push_back(minus(a, b));
  for (const Whole& a : along)
    for (const Whole& b : along) axes.push_back(times(a, b));
  const std::vector<Whole> crosses = axes;
  for (const Whole& a : crosses)
    for (const Whole& b : along) axes.push_back(times(a, b));
  axes.insert(axes.end(), along.begin(), along.end());
  for (const Whole& axis : axes) {
    const auto dot = [&](Whole a) { return a[0] * axis[0] + a[1] * axis[1] + a[2] * axis[2]; };
    const auto [p_low, p_high] = std::minmax({dot(p[0]), dot(p[1]), dot(p[2])});
    const auto [q_low, q_high] = std::minmax({dot(q[0]), dot(q[1]), dot(q[2])});
    if (p_high < q_low || q_high < p_low) return false;
  }
  return true;
}

// Coordinates 0 to 3: most pairs touch somewhere, share corners or planes, or are no triangles at all.
TEST(Predicates, LatticeTrianglesMeetAsWholeNumbersSay) {
  std::mt19937 random(11);
  std::uniform_int_distribution<std::int64_t> at(0, 3);
  int meeting = 0;
  for (int n = 0; n < 4000; ++n) {
    std::array<Whole, 3> p, q;
    for (Whole& v : p) v = {at(random), at(random), n % 3 == 0 ? 1 : at(random)};
    for (Whole& v : q) v = {at(random), at(random), n % 3 == 0 ? 1 : at(random)};
    const bool expected = meet_by_separating_axes(p, q);
    meeting += expected ? 1 : 0;
    // Off the lattice of floats, with coordinates that are still exact in double.
    const double scale = 1.0 + 0x1p-20;
    const Corners a{point(p[0], scale), point(p[1], scale), point(p[2], scale)};
    const Corners b{point(q[0], scale), point(q[1], scale), point(q[2], scale)};
    ASSERT_EQ(triangles_meet(a, b), expected) << "pair " << n;
    ASSERT_EQ(triangles_meet(b, a), expected) << "pair " << n << " swapped";
    ASSERT_EQ(nearest_of_triangles(a, b).squared_m2 == 0.0, expected) << "pair " << n;
  }
  EXPECT_GT(meeting, 1000);
  EXPECT_LT(meeting, 3000);
}

TEST(Predicates, AHairApartIsApart) {
  // The edge under a corner at 2/3 as rounded (down) still passes the slanted triangle; one spacing above it does not.
  const Corners slanted{Point{0, 0, 0}, Point{3, 0, 1}, Point{0, 3, 1}};
  const double below = 2.0 / 3.0;
  const double above = std::nextafter(below, 1.0);
  for (const auto& [z, meets] : {std::pair{0.5, true}, std::pair{below, true}, std::pair{above, false}}) {
    const Corners standing{Point{1, 1, z}, Point{1, 1, 5}, Point{1, 2, 5}};
    EXPECT_EQ(triangles_meet(slanted, standing), meets) << z;
    EXPECT_EQ(nearest_of_triangles(slanted, standing).squared_m2 == 0.0, meets) << z;
  }
  const Corners flat{Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}};
  const double hair = 1e-200;
  const Corners over{Point{0.25, 0.25, hair}, Point{0.5, 0.25, 1}, Point{0.25, 0.5, 1}};
  EXPECT_FALSE(triangles_meet(flat, over));
  EXPECT_GT(nearest_of_triangles(flat, over).squared_m2, 0.0);
}

}  // namespace
}  // namespace broadside::exact
