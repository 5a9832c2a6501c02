// The manifold made for two boxes against the general one: the same points, with the same keys, in the same order.
#include "core/method/rigid/box_manifold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/polytope_manifold.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

constexpr float kReachM = 0.1F;

struct BoxPair {
  Subject a;
  Subject b;

  [[nodiscard]] std::string text() const { return text_of(a) + "\n" + text_of(b); }
};

Quat product(Quat p, Quat q) {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}
Quat unit(Quat q) {
  const float size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}
// By about `angle` about any axis.
Quat tilted(Draw& draw, Quat q, float angle) {
  const Vec3 half = draw.in_cube(0.5F * angle);
  return unit(product(q, {1.0F, half.x, half.y, half.z}));
}

// Two cubes, two dominoes, or two boxes of any sides.
BoxPair any_sizes(Draw& draw) {
  const auto any = [&] { return box({draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F)}); };
  const int which = draw.below(3);
  if (which == 0) return {box({0.5F, 0.5F, 0.5F}), box({0.5F, 0.5F, 0.5F})};
  if (which == 1) return {box({0.1F, 0.5F, 0.25F}), box({0.1F, 0.5F, 0.25F})};
  return {any(), any()};
}

BoxPair anywhere(Draw& draw) {
  BoxPair p = any_sizes(draw);
  p.a.pose = {draw.in_cube(1.0F), draw.turn()};
  p.b.pose.q = draw.turn();
  const float apart = draw.between(0.0F, 1.1F) * (p.a.shape.size_m + p.b.shape.size_m);
  p.b.pose.x = p.a.pose.x + apart * normalized(draw.in_cube(1.0F));
  return p;
}

// Face to face, tilted by 1e-6 to 10^log_tilt, a little apart or overlapping, and shifted along the face by up to
// `shift` of the sides. turn: of B against A before it is tilted; it takes axes to axes.
BoxPair face_to_face(Draw& draw, Quat turn, float shift, float log_tilt = -1.0F) {
  BoxPair p = any_sizes(draw);
  p.a.pose = {draw.in_cube(1.0F), draw.turn()};
  p.b.pose.q = tilted(draw, unit(product(p.a.pose.q, turn)), std::pow(10.0F, draw.between(-6.0F, log_tilt)));
  const TurnedAxes of_a = turned_axes(p.a.pose.q);
  const TurnedAxes of_b = turned_axes(p.b.pose.q);
  const int axis = draw.below(3);
  const Vec3 l = turned_back(of_b, of_a[axis]);
  const Vec3 half = p.b.shape.half;
  const float apart = p.a.shape.half[axis] + std::abs(l.x) * half.x + std::abs(l.y) * half.y + std::abs(l.z) * half.z +
                      draw.between(-0.01F, 0.04F);
  Vec3 d = draw.in_cube(shift);
  for (int k = 0; k < 3; ++k) d[k] = k == axis ? (draw.below(2) == 0 ? apart : -apart) : d[k] * p.a.shape.half[k];
  p.b.pose.x = p.a.pose.x + turned(of_a, d);
  return p;
}

struct BothManifolds {
  SeparatingAxis axis;
  float rounding_m = 0.0F;
  Manifold own;
  Manifold general;

  // Both normals are the separating axis, so the points are those of the faces and not nearest points.
  [[nodiscard]] bool show_faces() const {
    return own.count > 0 && general.count > 0 && own.normal == axis.normal && general.normal == axis.normal;
  }
};

BothManifolds both_of(const BoxPair& p) {
  const PlacedShape a = placed_shape(p.a.shape, p.a.pose, p.a.pose.x);
  const PlacedShape b = placed_shape(p.b.shape, p.b.pose, p.a.pose.x);
  BothManifolds out;
  out.rounding_m = contact_rounding_m(a, b);
  out.axis = separating_axis_of_boxes(a, b, out.rounding_m, kReachM);
  box_manifold(box_polytope(a), box_polytope(b), out.axis, out.rounding_m, kReachM, out.own);
  polytope_manifold(box_polytope(a), box_polytope(b), out.axis, 0.0F, 0.0F, out.rounding_m, kReachM, out.general);
  return out;
}

const ManifoldPoint* point_named(const Manifold& m, std::uint32_t feature) {
  for (int k = 0; k < m.count; ++k)
    if (m.points[k].feature == feature) return &m.points[k];
  return nullptr;
}

bool has_point_at(const Manifold& m, const ManifoldPoint& p, float near_m) {
  for (int k = 0; k < m.count; ++k)
    if (length(m.points[k].point - p.point) <= near_m && std::abs(m.points[k].gap_m - p.gap_m) <= near_m) return true;
  return false;
}

// How many points of `of` have keys that `in` has too.
int keys_shared(const Manifold& of, const Manifold& in) {
  int shared = 0;
  for (int k = 0; k < of.count; ++k) shared += point_named(in, of.points[k].feature) != nullptr ? 1 : 0;
  return shared;
}

bool has_keys_in_order(const Manifold& m) {
  for (int k = 1; k < m.count; ++k)
    if (!(m.points[k - 1].feature < m.points[k].feature)) return false;
  return true;
}

// The point where two nearly parallel lines cross is off by rounding divided by their angle.
constexpr float kNearM = 1.0e-3F;

// Where more than four points are found, rounding may choose another one of two equally good points; that happens in at
// most one pair of 200.
constexpr int kOfOthers = 200;

TEST(BoxManifolds, HaveThePointsOfTheGeneralOne) {
  Draw draw(1);
  int pairs = 0;
  int others = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    const BoxPair p =
        trial % 3 == 0 ? anywhere(draw) : face_to_face(draw, draw.quarter_turns(), trial % 3 == 1 ? 1 : 0);
    const BothManifolds both = both_of(p);
    ASSERT_EQ(both.own.count > 0, both.general.count > 0) << p.text();
    ASSERT_TRUE(has_keys_in_order(both.own)) << p.text();
    if (!both.show_faces()) continue;
    ++pairs;
    ASSERT_GE(both.own.count, both.general.count) << p.text();
    bool is_other = false;
    for (int k = 0; k < both.general.count; ++k)
      is_other |= point_named(both.own, both.general.points[k].feature) == nullptr &&
                  !has_point_at(both.own, both.general.points[k], kNearM);
    others += is_other ? 1 : 0;
  }
  EXPECT_GT(pairs, 10000);
  EXPECT_LT(others * kOfOthers, pairs);
}

// Boxes beside or on each other have parallel edges, and no edge of a face may be taken for an edge of the other face.
// The keys decide in which order points are solved. Before, the keys of dominoes in a row had another order, and the
// dominoes leaned.
TEST(BoxManifolds, OfNeighborsHaveTheKeysOfTheGeneralOneInItsOrder) {
  Draw draw(2);
  int pairs = 0;
  int others = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const BoxPair p = face_to_face(draw, {1, 0, 0, 0}, trial % 2 == 0 ? 1.0F : 0.01F);
    const BothManifolds both = both_of(p);
    if (!both.show_faces()) continue;
    ++pairs;
    bool is_same = both.own.count == both.general.count;
    for (int k = 0; is_same && k < both.own.count; ++k) {
      is_same = both.own.points[k].feature == both.general.points[k].feature;
      if (!is_same) break;
      ASSERT_NEAR(both.own.points[k].gap_m, both.general.points[k].gap_m, kNearM) << p.text();
    }
    others += is_same ? 0 : 1;
  }
  EXPECT_GT(pairs, 10000);
  EXPECT_LT(others * kOfOthers, pairs);
}

// For a box that stands on the middle of another one: toward whatever side it would tilt, a contact point holds it
// there.
TEST(BoxManifolds, HoldABoxOnAllSides) {
  Draw draw(3);
  int pairs = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const BoxPair p = face_to_face(draw, draw.quarter_turns(), 0.05F, -2.0F);
    const BothManifolds both = both_of(p);
    if (!both.show_faces()) continue;
    const Vec3 n = both.own.normal;
    const Vec3 across = unit_across(n);
    const Vec3 other = cross(n, across);
    const Vec3 half_a = p.a.shape.half;
    const Vec3 half_b = p.b.shape.half;
    const float least_half = std::min({half_a.x, half_a.y, half_a.z, half_b.x, half_b.y, half_b.z});
    const Vec3 center = p.b.pose.x - p.a.pose.x;
    ++pairs;
    for (int k = 0; k < 16; ++k) {
      const float angle = 0.3926990F * static_cast<float>(k);
      const Vec3 way = std::cos(angle) * across + std::sin(angle) * other;
      float farthest = -1.0e30F;
      for (int i = 0; i < both.own.count; ++i)
        farthest = std::max(farthest, dot(way, both.own.points[i].point - center));
      ASSERT_GT(farthest, 0.5F * least_half) << k << "\n" << p.text();
    }
  }
  EXPECT_GT(pairs, 2000);
}

// Warm starting finds points by their keys. When a body moves slowly, a step changes as few keys as with the general
// manifold.
TEST(BoxManifolds, KeepTheirKeysThroughSmallMotions) {
  Draw draw(4);
  int points = 0;
  int own = 0;
  int general = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    BoxPair p = trial % 2 == 0 ? anywhere(draw) : face_to_face(draw, draw.quarter_turns(), 1.0F);
    const BothManifolds before = both_of(p);
    p.b.pose.x = p.b.pose.x + draw.in_cube(1.0e-4F);
    p.b.pose.q = tilted(draw, p.b.pose.q, 1.0e-4F);
    const BothManifolds after = both_of(p);
    if (before.own.count == 0 || before.general.count == 0 || after.own.count == 0) continue;
    points += before.general.count;
    own += keys_shared(before.own, after.own);
    general += keys_shared(before.general, after.general);
  }
  EXPECT_GT(points, 10000);
  EXPECT_GT(own * 10, points * 9);
  EXPECT_GT(own * 1000, general * 995);
}

// The upper one is 5 mm to the side of the lower one, whose highest edge is thus not under its face.
TEST(BoxManifolds, OfFacesOverEachOtherHaveAllTheirPoints) {
  BoxPair p;
  p.a = p.b = {box({0.5F, 0.25F, 0.25F}).shape, {}};
  p.b.pose.x = {0.06F, 0.55F, -0.005F};
  p.a.pose.q = unit({1.0F, -0.0076F, 0.0F, 0.0F});
  const BothManifolds both = both_of(p);
  EXPECT_EQ(both.own.count, 4);
  EXPECT_EQ(both.general.count, 4);
  EXPECT_TRUE(both.show_faces());
}

// How far outside the box the point is along an axis of it.
float outside_m(const Subject& box, Vec3 p) {
  const Vec3 at = turned_back(turned_axes(box.pose.q), p - box.pose.x);
  return std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) - box.shape.half.x;
}

// Cubes that lie askew on each other's edges, as far along the edge as it is long, and overlap by rounding or not. The
// corner that is deepest then may lie beside the other cube.
TEST(BoxManifolds, OfEdgesThatJustTouchHaveTheirPointsOnBothCubes) {
  Draw draw(3);
  Subject a = box({0.5F, 0.5F, 0.5F});
  Subject b = a;
  int found_points = 0;
  for (int trial = 0; trial < 400000; ++trial) {
    const float tilt = std::pow(10.0F, draw.between(-5.0F, -3.0F));
    const float off = std::pow(10.0F, draw.between(-7.0F, -4.0F));
    a.pose = {draw.in_cube(10.0F), tilted(draw, {}, tilt)};
    b.pose = {
        a.pose.x + Vec3{1.0F + draw.between(-off, off), 1.0F + draw.between(-off, off), draw.between(-1.0F, 1.0F)},
        tilted(draw, {}, tilt)};
    Manifold found[kPatchesOfPair];
    const int count = make_manifolds(a.shape, a.pose, b.shape, b.pose, 0.001F, found);
    for (int k = 0; k < count; ++k)
      for (int n = 0; n < found[k].count; ++n) {
        const Vec3 p = a.pose.x + found[k].points[n].point;
        ++found_points;
        ASSERT_LT(std::max(outside_m(a, p), outside_m(b, p)), 0.01F) << text_of(a) << "\n" << text_of(b);
      }
  }
  EXPECT_GT(found_points, 400000);
}

}  // namespace
}  // namespace broadside::core
